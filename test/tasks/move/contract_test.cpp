#include "tasks/move/agent.hpp"
#include "test/contract/task_contract.hpp"
#include "test/tasks/move/straight_arm.hpp"

namespace mrroc::contract {

struct Move {
  using Agent = any_motion::Arm;
  static constexpr const char* kFolder = "tasks/move";
  static auto behaviours() { return any_motion::kMove; }
  static Outcome run(any_motion::Arm::X& x, auto& port) {
    x.c.plan = std::make_shared<const any_motion::ArmPlan>(any_motion::plan_of_text(R"(
[arm1]
start = [0.3, 0, 0, 0, 0, 0]
order = ["there", "back"]
[arm1.there]
positions = [0.1, 0, 0, 0, 0, 0]
velocity = [1.0]
acceleration = [1.0]
[arm1.back]
positions = [0, 0, 0, 0, 0, 0]
velocity = [1.0]
acceleration = [1.0]
)")
                                                               .arms[0]);
    x.c.together = true;
    return any_motion::run_program(x, port);
  }
  static void configure(const Config& config) {
    std::ignore = any_motion::read_motions(config.section("task"), {{"arm1", 6}});
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(Move, TaskContract, Move);

}  // namespace mrroc::contract
