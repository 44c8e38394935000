// Arrival of an arm at its goal, and the closing of its brakes.
#include <gtest/gtest.h>

#include <cmath>

#include "edp/control_law.hpp"
#include "test/base/random_pose.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

using mrroc::test::distance;

/// @return a way along an axis of E in n_s steps
EffectorCommand shift(Rig& rig, Axis axis, double way, int n_s, Interpolation mu = Interpolation::mim) {
  ArmCommand a;
  a.mu = mu;
  a.reference = Reference::relative;
  a.representation = Representation::xyz_angle_axis;
  a.pose[static_cast<std::size_t>(axis)] = way;
  a.n_s = a.n_Q = static_cast<std::uint16_t>(n_s);
  return rig.set_arm(a);
}

/// @return in how many steps the drives are on although the arm holds, after the last command
int held_steps(Rig& rig) {
  int steps = 0;
  rig.after_each_step = [&] { steps += rig.last.enabled && rig.driver.state() == DriverState::holding; };
  rig.silence(30);
  rig.after_each_step = nullptr;
  EXPECT_FALSE(rig.last.enabled);
  return steps;
}

TEST(DriverRest, TheRegulatorsHoldAStoppedArmForTheirStepsAndLongerAtAGoal) {
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
  EXPECT_EQ(held_steps(rig), Driver::kBrakesCloseAfter);
  rig.macrostep(shift(rig, Axis::x, 0.02, 100));
  EXPECT_EQ(held_steps(rig), Driver::kSettleAtGoal);
  rig.macrostep(rig.velocity({u(-0.05), u(), u(), u(), u(), u()}));
  EXPECT_EQ(held_steps(rig), Driver::kBrakesCloseAfter) << "it has no goal any more";
}

TEST(DriverRest, AMotionThatCameFromTheBrakesIsHeldAsLongAsTheFirstOne) {
  Rig rig;
  rig.synchronise();
  for (int k = 0; k < 3; ++k) {
    rig.macrostep(rig.velocity({u(0.01), u(), u(), u(), u(), u()}));
    rig.silence(4);
    EXPECT_TRUE(rig.last.enabled) << k;
    rig.silence(20);
    EXPECT_FALSE(rig.last.enabled) << k;
  }
}

TEST(DriverRest, AGoalMayLieNearerToALimitThanAStopNeeds) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    Rig rig;
    rig.synchronise();
    const Pose goal = rig.driver.set_point().T_0E * Pose{Matrix3::Identity(), Vector3(0.599, 0, 0)};
    const EffectorReply reply = rig.macrostep(shift(rig, Axis::x, 0.599, 1000, mu));
    EXPECT_EQ(reply.verdict, Verdict::executed);
    rig.silence(12);
    EXPECT_EQ(rig.driver.fault().code, FaultCode::none);
    EXPECT_EQ(rig.driver.state(), DriverState::holding);
    EXPECT_LT(distance(rig.driver.set_point().T_0E, goal), 1e-9);
  }
}

TEST(DriverRest, AGoalIsNotPassedAlsoWhenTheMotionBeforeEndedWithItsPassiveStep) {
  Rig rig;
  rig.synchronise();
  EffectorCommand velocity = rig.velocity({u(0.05), u(), u(), u(), u(), u()});
  velocity.arm.n_Q = static_cast<std::uint16_t>(velocity.arm.n_s + 1);
  rig.macrostep(velocity);
  rig.silence(10);
  const double start = rig.driver.set_point().T_0E.p.x();
  double farthest = start;
  rig.after_each_step = [&] { farthest = std::max(farthest, rig.driver.set_point().T_0E.p.x()); };
  rig.macrostep(shift(rig, Axis::x, 0.06, 100));  // 0.3 m/s
  rig.silence(12);
  EXPECT_NEAR(rig.driver.set_point().T_0E.p.x(), start + 0.06, 1e-9);
  EXPECT_LT(farthest, start + 0.06 + 1e-9);
}

TEST(DriverRest, AToolThatComesBehindAMotionDoesNotMoveTheWristsGoal) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    Rig rig;
    rig.synchronise();
    const Pose T_WE = rig.world.T_WE;
    EffectorCommand turn = shift(rig, Axis::x, 0.06, 100, mu);  // 0.3 m/s
    turn.arm.pose[5] = 0.3;
    const Pose goal = rig.driver.set_point().T_0E *
                      pose_from_angle_axis((Vector6() << 0.06, 0, 0, 0, 0, 0.3).finished()) * T_WE.inverse();
    rig.macrostep(turn);
    EffectorCommand tool = rig.command(Instruction::set);
    tool.set = Part::robot_model | Part{};
    tool.robot_model.set_tool = true;
    tool.robot_model.tool_representation = Representation::xyz_angle_axis;
    tool.robot_model.tool = {0.3, -0.2, 0.1, 0, 1, 0};
    ASSERT_NE(rig.macrostep(tool).verdict, Verdict::refused);
    rig.silence(40);
    ASSERT_EQ(rig.driver.state(), DriverState::holding) << describe(rig.driver.fault());
    EXPECT_LT(distance(rig.arm.forward(rig.driver.set_point().axes.joints), goal), 1e-6);
  }
}

TEST(DriverRest, AnArmWhoseOwnerIsGoneStopsWhereItCanAndDoesNotGoOnToItsGoal) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    Rig rig;
    rig.synchronise();
    const double goal = rig.driver.set_point().T_0E.p.x() + 0.06;
    rig.driver.take(shift(rig, Axis::x, 0.06, 100, mu));  // 0.3 m/s
    for (int k = 0; k < 70; ++k) rig.step();
    rig.driver.drop_owner();
    EXPECT_EQ(held_steps(rig), Driver::kBrakesCloseAfter) << "it has no goal any more";
    EXPECT_GT(std::abs(rig.driver.set_point().T_0E.p.x() - goal), 1e-3);
  }
}

TEST(DriverRest, AStopThatComesShortlyBeforeAGoalEndsThereAndNotBeyondALimit) {
  constexpr double kWay = 19;  // [rad]
  DriverParameters p = Rig::parameters();
  p.limits.motor_acceleration = Limits{}.motor_acceleration;
  const FakeArm arm;
  const double limit =
      arm.axis(0).joint.upper * std::abs(FakeArm::kGear[0]) - 1e-6;  // before that of the motor
  AxisVector start = AxisVector::Zero(FakeArm::kAxes);
  start[0] = limit - kWay;
  p.synchro_joints = arm.joints_from_motors(start);
  int arrived = 0;
  for (int late = 1; late < 118; ++late) {
    Rig rig(p, p.synchro_joints);
    rig.synchronise();
    double farthest = limit - kWay;
    rig.after_each_step = [&] { farthest = std::max(farthest, rig.driver.set_point().axes.motors[0]); };
    ArmCommand a;
    a.mu = Interpolation::mim;
    a.representation = Representation::motors;
    a.pose[0] = limit;
    a.n_s = 100;
    a.n_Q = 99;
    rig.driver.take(rig.set_arm(a));  // 95 rad/s
    for (int k = 0; k < late; ++k) rig.step();
    ASSERT_FALSE(rig.driver.standstill().at_rest());
    rig.driver.drop_owner();
    rig.silence(20);
    ASSERT_EQ(rig.driver.fault().code, FaultCode::none) << describe(rig.driver.fault());
    ASSERT_LT(farthest, limit + 1e-9) << "stopped after " << late << " steps";
    EXPECT_EQ(rig.driver.set_point().motor_increment, AxisVector::Zero(FakeArm::kAxes));
    const bool there = std::abs(farthest - limit) < 1e-9;
    EXPECT_TRUE(there || arrived == 0) << late;
    arrived += there;
  }
  EXPECT_GT(arrived, 20) << "the last steps, in which a stop would have led beyond the goal";
  EXPECT_LT(arrived, 60);
}

// A slow motion passes its goal a little and returns. What it meets on the way back stops it as on the way there.
TEST(DriverRest, TheWayBackToAGoalIsStoppedByTooMuchForce) {
  const double force = 1.03 * Limits{}.contact_force[Axis::z];
  int stopped = 0;
  for (const double sign : {1., -1.}) {
    Rig rig;
    rig.synchronise();
    const double start = rig.driver.set_point().T_0E.p.z();
    double before = start;
    bool returns = false;
    rig.after_each_step = [&] {
      const double now = rig.driver.set_point().T_0E.p.z();
      if (now < before - 1e-9) returns = true;
      if (returns) rig.world.sensor_offset[Axis::z] = sign * force;
      before = now;
    };
    rig.macrostep(shift(rig, Axis::z, 0.01, 100));  // 0.05 m/s
    FaultCode code = FaultCode::none;
    for (int k = 0; k < 12; ++k)
      if (const EffectorReply reply = rig.silence(1); reply.fault.code != FaultCode::none)
        code = reply.fault.code;
    EXPECT_TRUE(returns);
    const bool there = std::abs(rig.driver.set_point().T_0E.p.z() - start - 0.01) < 1e-9;
    EXPECT_EQ(there, code == FaultCode::none);
    stopped += code == FaultCode::force_limit;
  }
  EXPECT_EQ(stopped, 1) << "a force that pushes it on is none";
}

TEST(DriverRest, FromATurnedWristTheFirstStepHasTheVelocityOfTheMotion) {
  DriverParameters p = Rig::parameters();
  p.synchro_joints << 0.1, -0.1, 0.1, 1.2, 0.5, -0.7;
  Rig rig(p, p.synchro_joints);
  rig.synchronise();
  const Vector3 before = rig.driver.set_point().T_0E.p;
  rig.driver.take(rig.velocity({u(0.05), u(-0.02), u(0.03), u(), u(), u()}));
  rig.step();
  const Vector3 speed = (rig.driver.set_point().T_0E.p - before) / p.dt;
  EXPECT_LT((rig.driver.set_point().v_0W.linear() - speed).norm(), 1e-9);
  EXPECT_NEAR(speed.norm(), Vector3(0.05, -0.02, 0.03).norm(), 1e-9);
}

}  // namespace
}  // namespace mrroc::edp::test
