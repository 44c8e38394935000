// Errors of a driver's model of its arm, made on purpose.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "test/rig/irb6_cell.hpp"
#include "test/sim/driver.hpp"

namespace mrroc::sim {
namespace {

using irb6::ParameterSet;

constexpr std::array kSets{ParameterSet::nominal, ParameterSet::calibrated};

struct Errors {
  double measured{};  // [m] largest distance of the true tip from the measured one
  double expected{};  // [m] largest that the two parameter sets predict
  double between{};   // [m] largest difference of the two
};

// A way of some decimetres with all axes turning.
Errors errors_on_a_way(int arm, ParameterSet truth, ParameterSet believed) {
  WorldParameters parameters = rig::irb6_cell();
  for (ArmParameters& p : parameters.arms) p.model = irb6::model_number(truth);
  World world(parameters);
  Driver driver(world, arm, believed);
  const char* const name = arm == 0 ? "irb6_postument" : "irb6_track";
  const auto real = irb6::make_arm(name, irb6::model_number(truth));
  const auto thought = irb6::make_arm(name, irb6::model_number(believed));
  const AxisVector start = world.start_joints(arm);
  const AxisVector zero = thought->motors_from_joints(start) - real->motors_from_joints(start);

  std::vector<HardwareCommand> commands(2);
  Errors e;
  for (int k = 0; k < 2000; ++k) {
    const double way = k < 1000 ? 1 : -0.6;
    driver.command = {u(0.06 * way), u(0.08 * way), u(-0.07), u(0.2 * way), u(-0.15 * way), u(0.3 * way)};
    commands[static_cast<std::size_t>(arm)] = driver.step();
    world.step(commands);
    const ArmTruth& now = world.truth(arm);
    const AxisVector motors = real->motors_from_joints(now.joints) + zero;
    const Vector3 thought_tip =
        (thought->forward(thought->joints_from_motors(motors)) * thought->tool_in_wrist()).p;
    const double measured = (driver.measured_pose().p - now.T_0E.p).norm();
    const double expected = (thought_tip - now.T_0E.p).norm();
    e.measured = std::max(e.measured, measured);
    e.expected = std::max(e.expected, expected);
    e.between = std::max(e.between, std::abs(measured - expected));
  }
  EXPECT_GT((world.truth(arm).T_0E.p - real->forward(start).p).norm(), 0.1) << "it did not move";
  return e;
}

TEST(KinematicError, BodiesHaveTheLengthsOfTheirSet) {
  WorldParameters parameters = rig::irb6_cell();
  for (ArmParameters& p : parameters.arms) p.model = irb6::model_number(ParameterSet::calibrated);
  const World world(parameters);
  for (int arm = 0; arm < 2; ++arm) {
    const auto robot = irb6::make_arm(arm == 0 ? "irb6_postument" : "irb6_track",
                                      irb6::model_number(ParameterSet::calibrated));
    const Pose T_0E = robot->forward(world.truth(arm).joints) * robot->tool_in_wrist();
    EXPECT_LT((T_0E.p - world.truth(arm).T_0E.p).norm(), 1e-9);
    EXPECT_LT((T_0E.R - world.truth(arm).T_0E.R).norm(), 1e-9);
  }
}

TEST(KinematicError, IsNoneWithTheSameSetInArmAndDriver) {
  for (int arm = 0; arm < 2; ++arm)
    for (const ParameterSet set : kSets) {
      const Errors e = errors_on_a_way(arm, set, set);
      EXPECT_LT(e.expected, 1e-9);
      EXPECT_LT(e.measured, 1e-4) << "more than an increment of each encoder";
    }
}

TEST(KinematicError, IsThatOfTheParametersWithDifferentSets) {
  for (int arm = 0; arm < 2; ++arm)
    for (const ParameterSet set : kSets) {
      const ParameterSet other =
          set == ParameterSet::nominal ? ParameterSet::calibrated : ParameterSet::nominal;
      const Errors e = errors_on_a_way(arm, set, other);
      EXPECT_LT(e.between, 1e-4);
      EXPECT_GT(e.measured, 0.001);
      EXPECT_LT(e.measured, 0.050);
      RecordProperty(
          "arm" + std::to_string(arm + 1) + "_true_set" + std::to_string(static_cast<int>(set)) + "_mm",
          std::to_string(1e3 * e.measured));
    }
}

}  // namespace
}  // namespace mrroc::sim
