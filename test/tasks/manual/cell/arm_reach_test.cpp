// Goals that the arms of manual operation refuse: beyond the ranges of joints and motors, and out of reach.
#include "tasks/manual/cell/arm_reach.hpp"

#include <gtest/gtest.h>

#include "base/representation.hpp"
#include "robots/irb6/arm.hpp"

namespace mrroc::manual {
namespace {

class ArmReach : public ::testing::TestWithParam<const char*> {
 protected:
  ArmReach() {
    Config config = Config::parse(std::string("[robots.arm1]\nmodel = \"") + GetParam() + "\"\n", "test");
    reach_ = make_arm_reach(config, "arm1");
    robot_ = irb6::make_arm(GetParam());
    now_.state = DriverState::holding;
    const AxisVector joints = robot_->front(), motors = robot_->motors_from_joints(joints);
    std::ranges::copy(joints, now_.joints.begin());
    std::ranges::copy(motors, now_.motors.begin());
    T_0E_ = robot_->forward(joints) * robot_->tool_in_wrist();
    const PoseNumbers pose = numbers_from_pose(Representation::xyz_angle_axis, T_0E_);
    std::copy_n(pose.begin(), 6, now_.T_0E.begin());
  }
  [[nodiscard]] std::optional<Fault> at(Representation space, const ecp::Coordinates& goal) const {
    return reach_->validation_error(space, goal, now_, {});
  }
  [[nodiscard]] std::optional<Fault> at(const Pose& T_0E) const {
    return at(Representation::xyz_angle_axis,
              axes_from_numbers(numbers_from_pose(Representation::xyz_angle_axis, T_0E), 6));
  }

  std::unique_ptr<manual::Reach> reach_;
  std::unique_ptr<irb6::Arm> robot_;
  EffectorReply now_;
  Pose T_0E_;
};

TEST_P(ArmReach, RefusesTheFirstAxisBeyondItsRangeAndTellsTheLimit) {
  const AxisVector joints = robot_->front();
  EXPECT_FALSE(at(Representation::joints, joints));
  EXPECT_FALSE(at(Representation::motors, robot_->motors_from_joints(joints)));
  for (int k = 0; k < robot_->axes(); ++k)
    for (const double beyond : {robot_->axis(k).motor.lower - 1, robot_->axis(k).motor.upper + 1}) {
      ecp::Coordinates goal = robot_->motors_from_joints(joints);
      goal[k] = beyond;
      const auto wrong = at(Representation::motors, goal);
      ASSERT_TRUE(wrong) << "motor " << k << " at " << beyond;
      EXPECT_EQ(wrong->code, FaultCode::joint_limit);
      EXPECT_EQ(wrong->axis, k);
      EXPECT_EQ(wrong->limit, beyond < 0 ? robot_->axis(k).motor.lower : robot_->axis(k).motor.upper);
    }
  ecp::Coordinates turned = joints;
  turned[0] = 9;
  const auto wrong = at(Representation::joints, turned);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->axis, 0);
}

TEST_P(ArmReach, RefusesPosesOutOfReachAndAllowsThoseThatTheToolReaches) {
  EXPECT_FALSE(at(T_0E_));
  EXPECT_FALSE(at(T_0E_ * Pose{Matrix3::Identity(), {0, 0, 0.02}}));
  const auto far = at(Pose{T_0E_.R, T_0E_.p + Vector3(5, 0, 0)});
  ASSERT_TRUE(far);
  EXPECT_EQ(far->code, FaultCode::unreachable_pose);
}

TEST_P(ArmReach, LeavesAnArmThatDoesNotKnowItsPositionToItsDriver) {
  now_.state = DriverState::not_synchronised;
  ecp::Coordinates goal = robot_->front();
  goal[0] = 9;
  EXPECT_FALSE(at(Representation::joints, goal));
}

INSTANTIATE_TEST_SUITE_P(BothArms, ArmReach, ::testing::Values("irb6_postument", "irb6_track"));

}  // namespace
}  // namespace mrroc::manual
