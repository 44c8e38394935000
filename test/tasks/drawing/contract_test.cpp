#include <vector>

#include "tasks/drawing/config.hpp"
#include "tasks/drawing/program.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {
namespace {

struct DrawingTask {
  static constexpr const char* kFolder = "tasks/drawing";
  static void configure(const Config& config) {
    (void)drawing::read_parameters(config);
    (void)drawing::read_hand_plan(config);
  }
};

struct DrawingCoordinator : DrawingTask {
  using Agent = drawing::Coordinator;
  static auto behaviours() {
    std::vector<Motion<Agent>> all(drawing::kCoordinator.begin(), drawing::kCoordinator.end());
    all.push_back(drawing::kWaitForStart);
    return all;
  }
  static Outcome run(Agent::X& x, auto& port) { return drawing::run_program(x, port); }
  static auto seen(Agent::X& x) { return std::tie(x.T.agent, x.T.h); }
  /// In m = 5 pens that are at any height have left their sheets, which ends the task.
  static void limit(Agent::X& x) {
    for (auto& arm : x.T.agent) arm.T_0E[2] = 0;
  }
  static bool same(const Agent::Memory& a, const Agent::Memory& b) {
    return a.k == b.k && a.recording == b.recording && a.p == b.p && a.T_previous.R == b.T_previous.R &&
           a.T_previous.p == b.T_previous.p && a.instant == b.instant && a.trigger == b.trigger &&
           a.paces == b.paces && a.touched == b.touched && a.met == b.met && a.held == b.held;
  }
};
INSTANTIATE_TYPED_TEST_SUITE_P(DrawingCoordinator, TaskContract, DrawingCoordinator);

struct DrawingArm : DrawingTask {
  using Agent = drawing::Arm;
  static auto behaviours() { return std::array{drawing::kTransparent}; }
  static Outcome run(Agent::X& x, auto& port) { return move(drawing::kTransparent, x, port); }
};
INSTANTIATE_TYPED_TEST_SUITE_P(DrawingArm, TaskContract, DrawingArm);

}  // namespace
}  // namespace mrroc::contract
