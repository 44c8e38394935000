#include <vector>

#include "tasks/rubik/config.hpp"
#include "tasks/rubik/program.hpp"
#include "tasks/rubik/turn/agent.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::contract {
namespace {

struct RubikTask {
  static constexpr const char* kFolder = "tasks/rubik";
  static void configure(const Config& config) { (void)rubik::read_parameters(config); }
};

/// An arm that acts in every cycle, or in none.
template <const std::array<Motion<rubik::Arm>, 6>& first, const std::array<Motion<rubik::Arm>, 6>& last,
          int variant>
struct RubikArm : RubikTask {
  using Agent = rubik::Arm;
  static auto behaviours() {
    std::vector<Motion<Agent>> all(rubik::kBetween.begin(), rubik::kBetween.end());
    all.insert(all.end(), first.begin(), first.begin() + 4);
    all.insert(all.end(), last.begin() + 4, last.end());
    return all;
  }
  static Outcome run(Agent::X& x, auto& port) {
    struct Same {
      decltype(port)& port_;
      void dispatch(const Motion<Agent>& motion, const Agent::Y& y) { port_.dispatch(motion, y); }
      Outcome wait() { return port_.wait(); }
      void read(Agent::X& image) {
        port_.read(image);
        if (image.T.m < 7) image.T.variant = variant;
      }
    } same{port};
    x.c.limits = {AxisVector::Constant(6, 1), AxisVector::Constant(6, 1)};
    return rubik::run_arm(x, same);
  }
  static bool same(const rubik::ArmMemory& a, const rubik::ArmMemory& b) {
    return a.way.count == b.way.count && a.way.points == b.way.points && a.weighed == b.weighed &&
           a.path.macrosteps() == b.path.macrosteps() && a.gap == b.gap && a.angle == b.angle &&
           a.T_0E.R == b.T_0E.R && a.T_0E.p == b.T_0E.p && a.turn.torque == b.turn.torque;
  }
};
using Acting = RubikArm<rubik::kWorker, rubik::kHolder, rubik::kActs>;
using Standing = RubikArm<rubik::kHolder, rubik::kWorker, rubik::kStands>;
INSTANTIATE_TYPED_TEST_SUITE_P(RubikArmThatActs, TaskContract, Acting);
INSTANTIATE_TYPED_TEST_SUITE_P(RubikArmThatStands, TaskContract, Standing);

}  // namespace
}  // namespace mrroc::contract
