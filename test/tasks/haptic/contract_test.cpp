#include <tuple>
#include <vector>

#include "tasks/haptic/config.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {
namespace {

struct Haptic {
  static constexpr const char* kFolder = "tasks/haptic";
  using Agent = haptic::Coordinator;
  static void configure(const Config& config) {
    std::ignore = haptic::read_parameters(config);
    std::ignore = haptic::read_operator(config, haptic::read_parameters(config).law);
  }
  static auto behaviours() {
    std::vector<Motion<Agent>> all(haptic::kBehaviours.begin(), haptic::kBehaviours.end());
    all.push_back(haptic::kWaitForStart);
    return all;
  }
  static Outcome run(Agent::X& x, auto& port) { return haptic::run_program(x, port); }
  static auto seen(Agent::X& x) { return std::tie(x.T.agent, x.T.h); }
  static bool same(const haptic::Memory& a, const haptic::Memory& b) {
    const auto of = [](const haptic::Memory& m) {
      const haptic::Coupling& c = m.coupling;
      return std::tie(m.begin, m.trigger, c.x_m, c.asked, c.place, c.fed, c.v_d, c.F_d, c.age, c.master.in,
                      c.master.out, c.master.store, c.slave.in, c.slave.out, c.slave.store);
    };
    return of(a) == of(b);
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Haptic, TaskContract, Haptic);

}  // namespace
}  // namespace mrroc::contract
