#include <vector>

#include "tasks/rubik/config.hpp"
#include "tasks/rubik/program.hpp"
#include "tasks/rubik/turn/agent.hpp"
#include "test/contract/task_contract.hpp"

namespace mrroc::rubik {

/// The task's part of an order changes, too.
void vary(ArmOrder& o, std::mt19937& random) {
  contract::vary(static_cast<Order&>(o), random);
  for (double& q : o.cube.point.motors) contract::wander(q, 100, random);
  o.cube.point.speed = contract::happens(0.9, random) ? 0.5 : 0;
  contract::wander(o.cube.turn.torque, 4, random);
  o.cube.turn.mobility = 0.1;
  contract::wander(o.cube.turn.angle, 1, random);
  contract::wander(o.cube.jaws, 0.05, random);
  contract::wander(o.cube.weight, 5, random);
}
bool same(const ArmReport& a, const ArmReport& b) {
  return contract::same(static_cast<const Report&>(a), static_cast<const Report&>(b)) &&
         a.cube.points == b.cube.points;
}

}  // namespace mrroc::rubik

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
      decltype(port)& inner;
      void dispatch(const Motion<Agent>& motion, const Agent::Y& y) { inner.dispatch(motion, y); }
      Outcome wait() { return inner.wait(); }
      void read(Agent::X& image) {
        inner.read(image);
        if (image.T.m < 7) image.T.variant = variant;
      }
    } same{port};
    x.c.limits = {AxisVector::Constant(6, 1), AxisVector::Constant(6, 1)};
    return rubik::run_arm(x, same);
  }
  static bool same(const rubik::ArmMemory& a, const rubik::ArmMemory& b) {
    return a.joint_path.count == b.joint_path.count && a.joint_path.points == b.joint_path.points &&
           a.weighed == b.weighed && a.path.macrosteps() == b.path.macrosteps() && a.gap == b.gap &&
           a.angle == b.angle && a.T_0E.R == b.T_0E.R && a.T_0E.p == b.T_0E.p &&
           a.turn.torque == b.turn.torque;
  }
};
using Acting = RubikArm<rubik::kWorker, rubik::kHolder, rubik::kActs>;
using Standing = RubikArm<rubik::kHolder, rubik::kWorker, rubik::kStands>;
INSTANTIATE_TYPED_TEST_SUITE_P(RubikArmThatActs, TaskContract, Acting);
INSTANTIATE_TYPED_TEST_SUITE_P(RubikArmThatStands, TaskContract, Standing);

}  // namespace
}  // namespace mrroc::contract
