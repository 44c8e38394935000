// Each check refuses exactly what lies beyond its limit, and says axis, value and limit.
#include "edp/guard.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/representation.hpp"
#include "edp/macrostep.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {
namespace {

const Limits kLimits;

ValidationError check_frame(const TaskFrameCommand& frame) {
  ArmCommand a;
  a.frame = frame;
  return check_arm(a, FakeArm::kAxes, kLimits);
}

void expect_fault(const ValidationError& fault, FaultCode code, int axis, double value, double limit) {
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, code) << fault->text.view();
  EXPECT_EQ(fault->axis, axis);
  EXPECT_DOUBLE_EQ(fault->value, value);
  EXPECT_DOUBLE_EQ(fault->limit, limit);
}

TEST(Guard, AnUnknownBehaviourIsNoErrorOfAnAxisThatCouldBeNamed) {
  TaskFrameCommand frame;
  frame[Axis::y].b = static_cast<Behaviour>(9);
  const ValidationError fault = check_frame(frame);
  expect_fault(fault, FaultCode::unknown_enum, -1, 9, 0);
}

TEST(Guard, EveryLimitOfARowIsLegalAndTheNextNumberIsNot) {
  const double big = std::numeric_limits<double>::infinity();
  const auto beyond = [&](double limit) { return std::nextafter(limit, big); };
  for (const Axis axis : kAxes) {
    const int k = static_cast<int>(axis);
    const double force = kLimits.force[axis];
    const auto with = [&](const AxisCommand& row) {
      TaskFrameCommand frame;
      frame[axis] = row;
      return check_frame(frame);
    };
    for (const double sign : {1.0, -1.0}) {
      EXPECT_FALSE(with(c(sign * force, 20, 1e-3)));
      expect_fault(with(c(sign * beyond(force), 20, 1e-3)), FaultCode::out_of_limits, k, sign * beyond(force),
                   force);
    }
    EXPECT_FALSE(with(g(0.01, kLimits.inertia, 0.01)));
    expect_fault(with(g(0.01, beyond(kLimits.inertia), 0.01)), FaultCode::out_of_limits, k,
                 beyond(kLimits.inertia), kLimits.inertia);
    expect_fault(with(g(0.01, -1e-9, 0.01)), FaultCode::out_of_limits, k, -1e-9, kLimits.inertia);
    EXPECT_FALSE(with(g(0.01, 1, kLimits.mobility)));
    EXPECT_TRUE(with(g(0.01, 1, beyond(kLimits.mobility))));
    // Far beyond, value and limit are not taken for one another.
    expect_fault(with(g(0.01, 1, 2 * kLimits.mobility)), FaultCode::out_of_limits, k, 2 * kLimits.mobility,
                 kLimits.mobility);
    expect_fault(with(g(0.01, 2 * kLimits.inertia, 0.01)), FaultCode::out_of_limits, k, 2 * kLimits.inertia,
                 kLimits.inertia);
    expect_fault(with(c(2 * force, 20, 1e-3)), FaultCode::out_of_limits, k, 2 * force, force);
    expect_fault(with(g(0.01, 1, -1e-9)), FaultCode::out_of_limits, k, -1e-9, kLimits.mobility);
    const double speed = axis < Axis::ax ? kLimits.linear_velocity : kLimits.angular_velocity;
    EXPECT_FALSE(with(u(-speed)));
    expect_fault(with(u(-speed * 1.001)), FaultCode::too_fast, k, speed * 1.001, speed);
  }
}

TEST(Guard, SpeedOfAllAxesTogetherCounts) {
  EXPECT_FALSE(check_frame({u(0.28), u(0.28), u(0.28), u(), u(), u()}));
  EXPECT_TRUE(check_frame({u(0.3), u(0.3), u(0.3), u(), u(), u()}));
}

TEST(Guard, ContactIsAsFastAsItsForceTimesItsMobility) {
  EXPECT_FALSE(check_frame({c(5, 20, 0.1), u(), u(), u(), u(), u()}));
  expect_fault(check_frame({c(5.1, 20, 0.1), u(), u(), u(), u(), u()}), FaultCode::too_fast, 0, 0.51, 0.5);
}

TEST(Guard, EntriesThatABehaviourDoesNotHaveMayBeAnythingFinite) {
  EXPECT_FALSE(check_frame({{Behaviour::unguarded, 1e9, 0.1, 1e9, 1e9}, u(), u(), u(), u(), u()}));
  EXPECT_FALSE(check_frame({{Behaviour::contact, 1, 1e9, 1, 0.01}, u(), u(), u(), u(), u()}));
  EXPECT_FALSE(check_frame({{Behaviour::guarded, 1e9, 0.1, 1, 0.01}, u(), u(), u(), u(), u()}));
}

TEST(Guard, PapersTablesAreLegal) {
  EXPECT_FALSE(check_frame({u(), u(), g(0.01, 5, 0.0025), u(), u(), u()}));
  EXPECT_FALSE(check_frame({c(0, 20, 0.005), c(0, 20, 0.005), c(1, 20, 0.005), u(), u(), c(5, 0.5, 0.025)}));
}

TEST(Guard, StepsOfAMacrostep) {
  ArmCommand a;
  const auto legal = [&](int n_s, int n_Q) {
    a.n_s = static_cast<std::uint16_t>(n_s);
    a.n_Q = static_cast<std::uint16_t>(n_Q);
    return !check_arm(a, FakeArm::kAxes, kLimits);
  };
  EXPECT_TRUE(legal(1, 1) && legal(1, 2) && legal(10, 1) && legal(10, 11) && legal(1000, 1001));
  EXPECT_FALSE(legal(0, 1) || legal(1001, 1) || legal(10, 0) || legal(10, 12) || legal(65535, 65535));
  const auto told = [&](std::uint16_t n_s, std::uint16_t n_Q) {
    a.n_s = n_s;
    a.n_Q = n_Q;
    return check_arm(a, FakeArm::kAxes, kLimits);
  };
  expect_fault(told(1234, 1), FaultCode::out_of_limits, -1, 1234, kMaxSteps);
  expect_fault(told(10, 15), FaultCode::out_of_limits, -1, 15, 11);
}

TEST(Guard, MotionBeyondAMotorOrJointLimitIsRefusedWithTheAxis) {
  const FakeArm arm;
  const AxisVector zero = AxisVector::Zero(FakeArm::kAxes);
  for (int k = 0; k < FakeArm::kAxes; ++k)
    for (const bool upper : {true, false}) {
      const AxisProperties& axis = arm.axis(k);
      AxisPositions to{zero, zero};
      const double motor = upper ? axis.motor.upper : axis.motor.lower;
      to.motors[k] = motor;
      EXPECT_FALSE(check_range(arm, {zero, zero}, to, 0));
      EXPECT_TRUE(check_range(arm, {zero, zero}, to, 0.1)) << "the stop would not fit";
      to.motors[k] = motor * 1.01;
      expect_fault(check_range(arm, {zero, zero}, to, 0), FaultCode::joint_limit, k, motor * 1.01, motor);
      to.motors[k] = 0;
      const double joint = upper ? axis.joint.upper : axis.joint.lower;
      to.joints[k] = joint * 1.01;
      expect_fault(check_range(arm, {zero, zero}, to, 0), FaultCode::joint_limit, k, joint * 1.01, joint);
      to.joints[k] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_TRUE(check_range(arm, {zero, zero}, to, 0)) << "what is no number is in no range";
    }
}

TEST(Guard, AxisOutOfItsLimitsMayComeBackAndNotGoFarther) {
  const FakeArm arm;
  AxisVector outside = AxisVector::Zero(FakeArm::kAxes);
  outside[1] = arm.axis(1).motor.upper + 3;
  AxisPositions from{AxisVector::Zero(FakeArm::kAxes), outside};
  AxisPositions to = from;
  to.motors[1] -= 1;
  EXPECT_FALSE(check_range(arm, from, to, 0));
  to.motors[1] += 2;
  EXPECT_TRUE(check_range(arm, from, to, 0));
  from.motors = to.motors = -outside;
  to.motors[1] += 1;
  EXPECT_FALSE(check_range(arm, from, to, 0));
  to.motors[1] -= 2;
  EXPECT_TRUE(check_range(arm, from, to, 0));
}

TEST(Guard, MotorSpeedIsCheckedForEachMotor) {
  const FakeArm arm;
  const AxisVector zero = AxisVector::Zero(FakeArm::kAxes);
  for (int k = 0; k < FakeArm::kAxes; ++k) {
    AxisVector to = zero;
    to[k] = -0.5;
    EXPECT_FALSE(check_motor_speed(arm, zero, to, 0.002));
    to[k] = -0.501;
    expect_fault(check_motor_speed(arm, zero, to, 0.002), FaultCode::too_fast, k, 0.501 / 0.002, 250);
  }
}

class Plan : public testing::Test {
 protected:
  Plan() {
    now.T_0E = Pose{};
    now.axes = {AxisVector::Zero(FakeArm::kAxes), AxisVector::Zero(FakeArm::kAxes)};
    now.motor_increment = AxisVector::Zero(FakeArm::kAxes);
  }
  std::optional<Fault> plan(Interpolation mu, Representation r, const PoseNumbers& pose, int n_s) {
    ArmCommand a;
    a.mu = mu;
    a.representation = r;
    a.pose = pose;
    a.n_s = static_cast<std::uint16_t>(n_s);
    return plan_macrostep(a, {now, now.T_0E, now.axes, false}, Pose{}, {&arm, kLimits, 0.002, 40}, result);
  }
  FakeArm arm;
  SetPoint now;
  Macrostep result;
};

TEST_F(Plan, PoseOutOfReachIsRefusedWithTheDistanceMissing) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    const std::optional<Fault> fault = plan(mu, Representation::xyz_angle_axis, {0, 0, -0.95}, 1000);
    expect_fault(fault, FaultCode::unreachable_pose, -1, 0.95 - FakeArm::kReach, 0);
  }
}

TEST_F(Plan, PoseTooFarForItsStepsIsRefusedAsTooFast) {
  expect_fault(plan(Interpolation::tcim_pose, Representation::xyz_angle_axis, {0, 0.2}, 100),
               FaultCode::too_fast, 1, 1, 0.5);
  expect_fault(plan(Interpolation::mim, Representation::motors, {0, 0, 0, 60}, 100), FaultCode::too_fast, 3,
               300, 250);
}

TEST_F(Plan, MotorMotionThatCouldNotBeStoppedBeforeALimitIsRefused) {
  // 199 of 200 rad in 2 s: the stop takes 19.5 more of the 1000 equal parts.
  expect_fault(plan(Interpolation::mim, Representation::motors, {0, 0, 0, 199}, 1000), FaultCode::joint_limit,
               3, 199 * 1.0195, 200);
  EXPECT_FALSE(plan(Interpolation::mim, Representation::motors, {0, 0, 0, 150}, 1000));
}

TEST_F(Plan, VelocityThatLeadsOutOfALimitInItsMacrostepIsRefused) {
  ArmCommand a;
  a.frame.z = u(0.4);
  a.n_s = 1000;
  expect_fault(plan_macrostep(a, Beginning{now, now.T_0E, now.axes, false}, Pose{},
                              {&arm, kLimits, 0.002, 40}, result),
               FaultCode::joint_limit, 2, 320, 245);
}

TEST_F(Plan, RefusalLeavesThePlanAsItWas) {
  ASSERT_FALSE(plan(Interpolation::mim, Representation::motors, {1}, 100));
  const AxisVector to = result.to;
  ASSERT_TRUE(plan(Interpolation::mim, Representation::motors, {1000}, 1));
  EXPECT_EQ(result.to, to);
  EXPECT_EQ(result.n_s, 100);
}

}  // namespace
}  // namespace mrroc::edp::test
