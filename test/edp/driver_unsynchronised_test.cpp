// An arm whose positions nobody knows: what its brakes hold is not watched, and it moves from where it is.
#include <gtest/gtest.h>

#include <limits>

#include "test/base/random_pose.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

void silence_sensor(Rig& rig) { rig.world.sensor_offset.v.fill(std::numeric_limits<double>::quiet_NaN()); }

TEST(Unsynchronised, WhatTheBrakesHoldMayBePushedAndItsSensorMayBeSilent) {
  Rig rig;
  rig.silence(2);
  silence_sensor(rig);
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) rig.world.slip[k] = 2000;
  const EffectorReply reply = rig.silence(10);
  EXPECT_EQ(reply.fault.code, FaultCode::none);
  EXPECT_EQ(reply.state, DriverState::not_synchronised);
  EXPECT_EQ(reply.F_a, Wrench{}) << "nobody knows how the sensor lies";
}

TEST(Unsynchronised, AMotionNeedsTheSensorAllTheSame) {
  Rig rig;
  rig.silence(2);
  silence_sensor(rig);
  const EffectorReply reply = rig.macrostep(rig.jog({0, 1}));
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.fault.code, FaultCode::sensor_silent);
  EXPECT_EQ(reply.state, DriverState::faulted);
}

TEST(Unsynchronised, AMotionBeginsWhereTheArmIsAndNotWhereItWas) {
  Rig rig;
  rig.silence(2);
  for (const std::size_t k : {0, 1}) rig.world.slip[k] = 200;
  rig.silence(1);
  const AxisVector before = rig.world.motors();
  EXPECT_EQ(rig.macrostep(rig.jog({0, 1})).verdict, Verdict::executed);
  rig.silence(12);
  const AxisVector moved = rig.world.motors() - before;
  const double increment = 1 / rig.arm.axis(0).increments_per_rad;
  EXPECT_NEAR(moved[1], 1, 3 * increment);
  for (const int k : {0, 2, 3, 4, 5}) EXPECT_NEAR(moved[k], 0, 2 * increment) << k;
}

TEST(Unsynchronised, ARefusedMotionLeavesTheSetPointWhereItWas) {
  Rig rig;
  rig.silence(2);
  rig.world.slip[1] = 200;
  rig.silence(1);
  const AxisVector before = rig.driver.set_point().axes.motors;
  EXPECT_EQ(rig.macrostep(rig.jog({100})).fault.code, FaultCode::too_fast);
  EXPECT_EQ(rig.driver.set_point().axes.motors, before);
  EXPECT_FALSE(rig.last.enabled);
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
}

// Faster and slower by 10 rad/s from macrostep to macrostep, each time with all the acceleration that is legal: up to the
// last digit, in which the set points are rounded. The way is more than the range of the motor.
TEST(Unsynchronised, NoPositionIsOutOfRange) {
  DriverParameters p = Rig::parameters();
  p.limits.motor_acceleration = 10 / p.dt;
  Rig rig(p);
  rig.silence(2);
  const double start = rig.world.motors()[1];
  double way = 0;
  for (int k = 1; k < 40; ++k) {
    const double next = k <= 20 ? k : 40 - k;
    way += next;
    const EffectorReply reply = rig.macrostep(rig.jog({0, next}, 50));
    ASSERT_EQ(reply.verdict, Verdict::executed) << k << ' ' << describe(reply.fault);
    ASSERT_EQ(rig.driver.fault().code, FaultCode::none) << k;
  }
  rig.silence(12);
  EXPECT_NEAR(rig.world.motors()[1] - start, way, 0.01);
  EXPECT_GT(way, 1.5 * rig.arm.axis(1).motor.upper);
}

TEST(Unsynchronised, TheSetPointHasANumberOfEveryAxisAndAPoseThatStays) {
  Rig rig;
  rig.silence(2);
  const Pose before = rig.driver.set_point().T_0E;
  rig.after_each_step = [&] {
    const SetPoint& set = rig.driver.set_point();
    ASSERT_EQ(set.axes.joints.size(), FakeArm::kAxes);
    ASSERT_EQ(set.axes.motors.size(), FakeArm::kAxes);
    ASSERT_EQ(set.T_0E.p, before.p);
    ASSERT_EQ(set.T_0E.R, before.R);
  };
  EXPECT_EQ(rig.macrostep(rig.jog({1, -2, 3, 0.5, -0.5, 0.25})).verdict, Verdict::executed);
  const EffectorReply reply = rig.silence(10);
  EXPECT_FALSE(reply.position_known);
  EXPECT_EQ(reply.joints, decltype(reply.joints){}) << "not known";
  rig.after_each_step = nullptr;
  EXPECT_TRUE(rig.synchronise().position_known);
}

}  // namespace
}  // namespace mrroc::edp::test
