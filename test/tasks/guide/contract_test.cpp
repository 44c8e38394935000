#include "tasks/guide/config.hpp"
#include "test/contract/solo_task.hpp"

namespace mrroc::contract {

struct Guide : SoloTask<guide::Arm, guide::kGuide> {
  static constexpr const char* kFolder = "tasks/guide";
  static void configure(const Config& given) {
    Config config = given.copy();
    for (const char* tool : {"pose=[0, 0, 0.25, 0, 0, 0]", "weight=10", "mass_centre=[0, 0, 0]"})
      config.set(std::string("robots.arm1.tool.") + tool);  // the cell's, not the task's
    std::ignore = guide::read_setup(config, "arm1");
    std::ignore = guide::read_operator(config, {}, 1e-3);
  }
  /// A plane that takes hold of a tool from afar, and never too strongly to go on.
  static Outcome run(guide::Arm::X& x, auto& port) {
    const auto k = std::make_shared<guide::Setup>();
    k->fixture = {{Matrix3::Identity(), {0, 0, 0.5}}, std::array{0.1, 0.1}};
    k->capture = 0.3;
    k->entry_speed = 1e9;
    x.c.k = k;
    return ecp::execute_rows<guide::Arm>(std::span<const Motion<guide::Arm>>(guide::kGuide), x, port);
  }
  static bool same(const guide::Memory& a, const guide::Memory& b) {
    return a.k == b.k && a.R_0W == b.R_0W && a.s == b.s && a.way == b.way;
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Guide, TaskContract, Guide);

}  // namespace mrroc::contract
