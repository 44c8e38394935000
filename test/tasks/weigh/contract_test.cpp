#include "tasks/weigh/weigh.hpp"
#include "test/contract/solo_task.hpp"

namespace mrroc::contract {

struct Weigh : SoloTask<weigh::Arm, weigh::kWeigh> {
  static constexpr bool kHasNoDefaults = true;  // nobody can guess the orientations
  static constexpr const char* kFolder = "tasks/weigh";
  static weigh::Memory memory(Config config) {
    for (const char* tool : {"pose=[0, 0, 0.25, 0, 0, 0]", "weight=10", "mass_centre=[0, 0, 0]"})
      config.set(std::string("robots.arm1.tool.") + tool);  // the cell's, not the task's
    return weigh::read_memory(config, "arm1");
  }
  static Outcome run(weigh::Arm::X& x, auto& port) {
    x.c = memory(Config::parse(weigh::config(), "weigh.toml"));
    return SoloTask::run(x, port);
  }
  static bool same(const weigh::Memory& x, const weigh::Memory& y) {
    const ecp::Weighing &a = x.weighing, &b = y.weighing;
    return a.sum.v == b.sum.v && a.readings == b.readings && a.F_b.v == b.F_b.v && a.F_c.v == b.F_c.v &&
           a.found.w == b.found.w && a.found.P == b.found.P && a.path.macrosteps() == b.path.macrosteps();
  }
  static void configure(const Config& config) { std::ignore = memory(config.copy()); }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Weigh, TaskContract, Weigh);

}  // namespace mrroc::contract
