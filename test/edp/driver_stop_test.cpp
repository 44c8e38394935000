// A driver brings the arm to rest when commands end, and goes on from there.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>

#include "test/edp/random_command.hpp"
#include "test/edp/set_point_watch.hpp"

namespace mrroc::edp::test {
namespace {

TEST(DriverStop, SilenceBringsEveryMotionSmoothlyToRestAndHolds) {
  std::mt19937_64 random(1);
  int moved = 0;
  for (int run = 0; run < 1000; ++run) {
    Rig rig;
    rig.synchronise();
    rig.world.stiffness.head<3>().setConstant(200);
    SetPointWatch watch(rig);
    bool to_a_pose = false;
    for (int k = 0; k < 3; ++k) {
      const ArmCommand a = random_motion(random);
      ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
      to_a_pose = a.mu != Interpolation::tcim_velocity;
    }
    const std::int64_t end = rig.driver.commanded_until();
    ASSERT_EQ(rig.world.reading().step, end);
    const double speed = watch.speed.cwiseAbs().maxCoeff();
    moved += speed > 0;
    watch.start();
    rig.macrostep();
    const bool still_moving = rig.driver.state() == DriverState::decelerating;
    EXPECT_TRUE(still_moving || speed == 0) << run;
    rig.silence(9);
    ASSERT_EQ(rig.driver.state(), DriverState::holding);
    ASSERT_EQ(rig.driver.commanded_until(), end);
    // Smoothstep: at most 1.5 times the mean deceleration; the axes are coupled by the kinematics.
    EXPECT_LT(watch.worst_acceleration, 1.5 / 40 * speed * 1.3 + 1e-4) << run;
    EXPECT_LT(watch.moving_steps, to_a_pose ? 91 : 40) << "back to the pose";
    const Pose rest = rig.driver.set_point().T_0E;
    const Pose arm_at_rest = rig.world.T_0E();
    rig.silence(20);
    EXPECT_EQ(rig.driver.set_point().T_0E.p, rest.p);
    // A return ends 10 steps before; the drives' last increments, of 4 um each, come after it.
    EXPECT_LT((rig.world.T_0E().p - arm_at_rest.p).norm(), to_a_pose ? 2e-5 : 1.2e-5)
        << "within 100 steps the arm is at rest";
    EXPECT_LT((rig.world.T_0E().p - rest.p).norm(), 5e-5) << "and where it is set to be";
  }
  EXPECT_GT(moved, 990) << "the motions must not have been standing still already";
}

TEST(DriverStop, MotorsThatWereInterpolatedStopInStep) {
  Rig rig;
  rig.synchronise();
  ArmCommand a;
  a.mu = Interpolation::mim;
  a.representation = Representation::motors;
  a.reference = Reference::relative;
  a.pose = {3, -4, 5, 6, -7, 8};
  a.n_s = a.n_Q = 100;
  const AxisVector start = rig.driver.set_point().axes.motors;
  for (int i = 0; i < 2; ++i) ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
  const AxisVector speed = rig.driver.set_point().motor_increment;
  int k = 0;
  rig.after_each_step = [&] {
    if (++k > 40) return;
    const AxisVector expected = speed * remaining_speed(k, 40);
    EXPECT_LT((rig.driver.set_point().motor_increment - expected).cwiseAbs().maxCoeff(), 1e-12) << k;
  };
  rig.silence(10);
  const AxisVector goal = start + 2 * axes_from_numbers(a.pose, FakeArm::kAxes);
  EXPECT_LT((rig.driver.set_point().axes.motors - goal).cwiseAbs().maxCoeff(), 1e-9) << "and return";
}

TEST(DriverStop, APoseFromRestIsReachedWithoutASpeedAboveTheCommandedOneAndNotPassed) {
  std::mt19937_64 random(9);
  for (int run = 0; run < 300; ++run) {
    Rig rig;
    rig.synchronise();
    ArmCommand a;
    a.mu = run % 2 ? Interpolation::mim : Interpolation::tcim_pose;
    a.reference = Reference::relative;
    a.representation = Representation::xyz_angle_axis;
    a.n_s = static_cast<std::uint16_t>(1 + pick(random, 100));
    a.n_Q = static_cast<std::uint16_t>(a.n_s + pick(random, 2));
    const double v = uniform(random, 0.01, 0.3);
    const Vector3 way = v * 0.002 * a.n_s * random_direction(random);
    a.pose = {way.x(), way.y(), way.z()};
    const Pose start = rig.driver.set_point().T_0E;
    double fastest = 0, beyond = 0;
    Vector3 last = start.p;
    rig.after_each_step = [&] {
      const Vector3& now = rig.driver.set_point().T_0E.p;
      fastest = std::max(fastest, (now - last).norm() / 0.002);
      beyond = std::max(beyond, (now - start.p).dot(way.normalized()) - way.norm());
      last = now;
    };
    ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
    rig.silence(10);
    EXPECT_LE(fastest, v + 1e-9);
    EXPECT_LE(beyond, v > 0.07 ? 1e-9 : 3.6e-4) << v;
    EXPECT_LT(mrroc::test::distance(rig.driver.set_point().T_0E, start * Pose{Matrix3::Identity(), way}),
              1e-8)
        << run;
    EXPECT_EQ(rig.driver.state(), DriverState::holding);
  }
}

TEST(DriverStop, AShortMacrostepAfterALongFastOneIsExecutedAndReached) {
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose})
    for (const int n_s : {1, 2, 5}) {
      Rig rig;
      rig.synchronise();
      const double x = rig.driver.set_point().T_0E.p.x();
      ArmCommand a;
      a.mu = mu;
      a.reference = Reference::relative;
      a.representation = Representation::xyz_angle_axis;
      a.n_s = a.n_Q = 200;
      a.pose = {0.12};  // 0.3 m/s
      ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
      a.n_s = a.n_Q = static_cast<std::uint16_t>(n_s);
      a.pose = {0.0006 * n_s};
      for (int k = 0; k < 60 / n_s; ++k)
        ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed) << n_s << " " << k;
      rig.silence(10);
      EXPECT_NEAR(rig.driver.set_point().T_0E.p.x() - x, 0.12 + 0.036, 1e-8) << n_s;
      a.pose = {0.003 * n_s};  // 1.5 m/s
      EXPECT_EQ(rig.macrostep(rig.set_arm(a)).fault.code, FaultCode::too_fast);
    }
}

TEST(DriverStop, WhoseOwnerIsGoneStopsWhereItCanAndNotAtItsGoal) {
  for (const int n_s : {20, 100}) {
    Rig told, dropped;
    for (Rig* rig : {&told, &dropped}) {
      rig->synchronise();
      ArmCommand a;
      a.mu = Interpolation::mim;
      a.representation = Representation::motors;
      a.reference = Reference::relative;
      a.pose = {0, 0.3 * n_s};
      a.n_s = a.n_Q = static_cast<std::uint16_t>(n_s);
      for (int k = 0; k < 2; ++k) ASSERT_EQ(rig->macrostep(rig->set_arm(a)).verdict, Verdict::executed);
    }
    dropped.driver.drop_owner();
    for (Rig* rig : {&told, &dropped}) rig->silence(10);
    EXPECT_NEAR(told.driver.set_point().axes.motors[1], 0.6 * n_s, 1e-6);
    EXPECT_GT(dropped.driver.set_point().axes.motors[1], 0.6 * n_s + 15 * 0.3);
    EXPECT_EQ(dropped.driver.state(), DriverState::holding);
  }
}

TEST(DriverStop, CommandAfterAHoldContinuesFromTheHeldSetPose) {
  std::mt19937_64 random(2);
  for (int run = 0; run < 200; ++run) {
    Rig rig;
    rig.synchronise();
    for (int k = 0; k < 3; ++k) rig.macrostep(rig.set_arm(random_motion(random)));
    rig.silence(run % 10);  // in the middle of the stop, or long after it
    const double speed = rig.driver.set_point().motor_increment.cwiseAbs().maxCoeff();
    SetPointWatch watch(rig);
    watch.speed = rig.driver.set_point().motor_increment;
    const Pose before = rig.driver.set_point().T_0E;
    // Contact without force: the law lets the speed that is left die out, or stands still.
    TaskFrameCommand frame{};
    for (const Axis a : kAxes) frame[a] = c(0, 20, 0.005);
    ASSERT_EQ(rig.macrostep(rig.velocity(frame)).verdict, Verdict::executed);
    EXPECT_LT(watch.worst_acceleration, 0.05 * speed + 2e-6) << run;
    if (speed == 0) {
      EXPECT_LT((rig.driver.set_point().T_0E.p - before.p).norm(), 1e-9);
    }
  }
}

TEST(DriverStop, HeldArmIsBrakedAndGoesOnWithoutAJump) {
  Rig rig;
  rig.synchronise();
  const EffectorCommand move = rig.velocity({u(0.05), u(), u(), u(), u(), u(0.1)});
  rig.macrostep(move);
  rig.silence(4);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  EXPECT_TRUE(rig.last.enabled) << "the regulators bring it to its place first";
  rig.silence(3);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  EXPECT_FALSE(rig.last.enabled);
  rig.world.slip[0] = 30;  // what the brakes let through is made good
  rig.silence(1);
  EXPECT_EQ(rig.macrostep(rig.velocity({})).verdict, Verdict::executed);
  EXPECT_TRUE(rig.last.enabled);
  const AxisVector error = rig.driver.set_point().axes.motors - rig.world.motors();
  EXPECT_LT(error.cwiseAbs().maxCoeff(), 2.5 / rig.arm.axis(0).increments_per_rad);
}

TEST(DriverStop, ArmAtRestIsNotMovedBySilence) {
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({}));
  const Pose before = rig.driver.set_point().T_0E;
  const EffectorReply reply = rig.macrostep();
  EXPECT_EQ(reply.state, DriverState::holding);
  EXPECT_EQ(reply.number, 0);
  EXPECT_EQ(reply.verdict, Verdict::none);
  EXPECT_EQ(reply.session, 7);
  EXPECT_EQ(rig.driver.set_point().T_0E.p, before.p);
}

}  // namespace
}  // namespace mrroc::edp::test
