// Limits of acceleration, workspace and contact force: refused as a command, brought to rest as a set point.
#include <gtest/gtest.h>

#include "edp/guard.hpp"
#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

TEST(GuardMotion, AccelerationUpToTheLimitIsLegal) {
  Limits limits;
  limits.motor_acceleration = 100;
  AxisVector before = AxisVector::Zero(2), after = before;
  after[1] = 0.2;
  EXPECT_FALSE(check_motor_acceleration(before, after, 0.002, limits));
  after[1] = -0.201;
  const ValidationError wrong = check_motor_acceleration(before, after, 0.002, limits);
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->code, FaultCode::excessive_acceleration);
  EXPECT_EQ(wrong->axis, 1);
  EXPECT_NEAR(wrong->value, 100.5, 1e-9);
  after[1] = std::nan("");
  EXPECT_TRUE(check_motor_acceleration(before, after, 0.002, limits));
}

TEST(GuardMotion, EachPartOfAVelocityHasItsOwnLimitOfAcceleration) {
  Limits limits;
  limits.linear_acceleration = 10;
  limits.angular_acceleration = 50;
  const double dt = 0.002;
  for (const double sign : {1., -1.}) {
    Twist after;
    after[Axis::y] = sign * 0.9999 * 10 * dt;
    after[Axis::az] = sign * 0.9999 * 50 * dt;
    EXPECT_FALSE(check_acceleration({}, after, dt, limits));
    after[Axis::az] = sign * 1.0001 * 50 * dt;
    ValidationError wrong = check_acceleration({}, after, dt, limits);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->code, FaultCode::excessive_acceleration);
    EXPECT_EQ(wrong->axis, 5);
    EXPECT_NEAR(wrong->value, 50.005, 1e-9);
    EXPECT_EQ(wrong->limit, 50);
    after[Axis::az] = 0;
    after[Axis::y] = sign * 1.0001 * 10 * dt;
    wrong = check_acceleration({}, after, dt, limits);
    ASSERT_TRUE(wrong);
    EXPECT_EQ(wrong->axis, 1);
    EXPECT_EQ(wrong->limit, 10);
  }
}

TEST(GuardMotion, FromOutsideTheWorkspaceEverySideLetsInAndNotFartherOut) {
  Limits limits;
  limits.workspace = Box{{-0.1, -0.2, 0.3}, {0.1, 0.2, 0.5}};
  for (int k = 0; k < 3; ++k)
    for (const bool below : {true, false}) {
      const double edge = below ? limits.workspace->lower[k] : limits.workspace->upper[k];
      const double out = below ? -1 : 1;
      Pose from, to;
      from.p = to.p = Vector3(0, 0, 0.4);
      from.p[k] = edge + 0.05 * out;
      to.p[k] = edge + 0.04 * out;
      EXPECT_FALSE(check_workspace(from, to, limits)) << k << " nearer, still outside";
      to.p[k] = from.p[k];
      EXPECT_FALSE(check_workspace(from, to, limits)) << k << " along the side";
      to.p[k] = edge + 0.051 * out;
      const ValidationError wrong = check_workspace(from, to, limits);
      ASSERT_TRUE(wrong) << k;
      EXPECT_EQ(wrong->code, FaultCode::outside_workspace);
      EXPECT_EQ(wrong->axis, k);
      EXPECT_EQ(wrong->limit, edge);
    }
}

TEST(GuardMotion, AnAxisWithTooMuchForceMayStandWhileAnotherOneMoves) {
  const Limits limits;
  for (const Axis loaded : kAxes)
    for (const Axis moving : kAxes)
      for (const double sign : {1., -1.}) {
        Wrench F_a;
        F_a[loaded] = sign * 1.01 * limits.contact_force[loaded];
        Twist v;
        v[moving] = 0.01 * sign;
        EXPECT_EQ(check_contact_force(F_a, v, limits).has_value(), moving == loaded);
        v[moving] *= -1;
        EXPECT_FALSE(check_contact_force(F_a, v, limits)) << "away, or along";
        F_a[loaded] = sign * limits.contact_force[loaded];
        v[moving] *= -1;
        EXPECT_FALSE(check_contact_force(F_a, v, limits)) << "up to the limit";
      }
}

TEST(GuardMotion, StepOfVelocityBeyondTheLimitIsRefusedAndASmallerOneIsNot) {
  DriverParameters p = Rig::parameters();
  p.limits.linear_acceleration = 10;
  p.limits.angular_acceleration = 50;
  for (const double direction : {1., -1.}) {
    Rig rig(p);
    rig.synchronise();
    const EffectorReply reply = rig.macrostep(rig.velocity({u(), u(direction * 0.0201), u(), u(), u(), u()}));
    EXPECT_EQ(reply.verdict, Verdict::refused);
    EXPECT_EQ(reply.fault.code, FaultCode::excessive_acceleration);
    EXPECT_EQ(reply.fault.axis, 1);
    rig.number = rig.driver.protocol().expected() - 1;
    for (double v = 0.0199; v < 0.1; v += 0.0199)
      ASSERT_EQ(rig.macrostep(rig.velocity({u(), u(direction * v), u(), u(), u(), u()})).verdict,
                Verdict::executed);
    EXPECT_EQ(rig.macrostep(rig.velocity({u(), u(-direction * 0.08), u(), u(), u(), u()})).verdict,
              Verdict::refused);
    EXPECT_EQ(rig.silence(5).state, DriverState::holding) << "the stop is within the limit";
  }
}

TEST(GuardMotion, MotorMotionsAreBoundAtTheirBeginningAndBeforeTheirPassiveStep) {
  DriverParameters p = Rig::parameters();
  p.limits.motor_acceleration = 5000;  // 10 rad/s in a step
  Rig rig(p);
  rig.synchronise();
  EXPECT_EQ(rig.macrostep(rig.jog({2.1}, 100)).fault.code, FaultCode::excessive_acceleration);
  rig.number = rig.driver.protocol().expected() - 1;
  EXPECT_EQ(rig.macrostep(rig.jog({1.9}, 100)).verdict, Verdict::executed);
  EXPECT_EQ(rig.macrostep(rig.jog({3.8}, 100)).verdict, Verdict::executed);
  EffectorCommand c = rig.jog({3.8}, 100);
  c.arm.n_Q = 101;
  EXPECT_EQ(rig.macrostep(c).fault.code, FaultCode::excessive_acceleration);
}

TEST(GuardMotion, VelocityThatAPassiveStepWouldBreakOffTooHardIsRefusedWithTheCommand) {
  DriverParameters p = Rig::parameters();
  p.limits.linear_acceleration = 100;  // 0.2 m/s in a step
  for (const Interpolation mu : {Interpolation::tcim_velocity, Interpolation::tcim_pose}) {
    Rig rig(p);
    rig.synchronise();
    const auto move = [&](double speed, std::uint16_t n_Q) {
      EffectorCommand c = rig.velocity({u(), u(speed), u(), u(), u(), u()}, 5);
      c.arm.mu = mu;
      c.arm.representation = Representation::xyz_angle_axis;
      c.arm.reference = Reference::relative;
      c.arm.pose = {0, speed * 0.01};
      c.arm.n_Q = n_Q;
      const EffectorReply reply = rig.macrostep(c);
      if (reply.verdict == Verdict::refused) rig.number = rig.driver.protocol().expected() - 1;
      return reply;
    };
    ASSERT_EQ(move(0.19, 6).verdict, Verdict::executed);
    ASSERT_EQ(move(0.19, 5).verdict, Verdict::executed);
    ASSERT_EQ(move(0.3, 5).verdict, Verdict::executed);
    const EffectorReply reply = move(0.3, 6);
    EXPECT_EQ(reply.verdict, Verdict::refused);
    EXPECT_EQ(reply.fault.code, FaultCode::excessive_acceleration);
    EXPECT_EQ(reply.fault.axis, 1);
    EXPECT_NEAR(reply.fault.value, 150, 1e-6);
    rig.silence(10);
    ASSERT_EQ(move(0.19, 6).verdict, Verdict::executed);
    EXPECT_EQ(move(0.3, 5).verdict, Verdict::refused) << "from a slower beginning";
  }
}

TEST(GuardMotion, VelocityOfAContactIsCheckedBeforeAndAfterItsPassiveStep) {
  DriverParameters p = Rig::parameters();
  p.limits.linear_acceleration = 5;  // 0.01 m/s in a step
  for (const bool before : {true, false}) {
    Rig rig(p);
    rig.synchronise();
    // 0.0098 m/s after 28 steps, 0.0101 m/s after 29.
    EffectorCommand soft = rig.velocity({u(), u(), c(4, 20, 0.01), u(), u(), u()}, 28);
    soft.arm.n_Q = before ? 28 : 29;
    ASSERT_EQ(rig.macrostep(soft).verdict, Verdict::executed);
    EXPECT_EQ(rig.driver.set_point().motor_increment.isZero(0), !before);
    EXPECT_GT(rig.driver.set_point().v_0W[Axis::z], 0.0097) << "the law keeps its memory";
    soft.number = ++rig.number;
    soft.arm.n_Q = before ? 29 : 28;
    EffectorReply reply = rig.macrostep(soft);
    if (before) reply = rig.silence(1);
    EXPECT_EQ(reply.fault.code, FaultCode::excessive_acceleration);
    EXPECT_EQ(reply.fault.axis, 2);
  }
}

TEST(GuardMotion, ForceThatWouldJerkTheSetPointBringsItToRest) {
  DriverParameters p = Rig::parameters();
  p.limits.linear_acceleration = 5;
  Rig rig(p);
  rig.synchronise();
  const EffectorCommand soft = rig.velocity({u(), u(), c(0, 1, 0.01), u(), u(), u()});
  EXPECT_EQ(rig.macrostep(soft).verdict, Verdict::executed);
  rig.world.sensor_offset[Axis::z] = 20;
  const EffectorReply reply = rig.macrostep(rig.velocity(soft.arm.frame));
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.fault.code, FaultCode::excessive_acceleration);
}

TEST(GuardMotion, NothingLeavesTheWorkspaceAndTheWayBackIsFree) {
  std::mt19937_64 random(5);
  DriverParameters p = Rig::parameters();
  p.limits.workspace = Box{{-0.1, -0.1, 0}, {0.12, 0.1, 0.2}};
  int stopped = 0;
  for (int run = 0; run < 100; ++run) {
    Rig rig(p);
    rig.synchronise();
    rig.after_each_step = [&] {
      const Vector3& at = rig.driver.set_point().T_0E.p;
      EXPECT_TRUE((at - p.limits.workspace->lower).minCoeff() > -1e-4 &&
                  (p.limits.workspace->upper - at).minCoeff() > -1e-4)
          << at.transpose();
    };
    const Vector3 v = 0.3 * random_direction(random);
    TaskFrameCommand frame{u(v.x()), u(v.y()), u(v.z()), u(), u(), u(run % 2)};
    EffectorReply reply;
    for (int k = 0; k < 100 && rig.driver.state() != DriverState::holding; ++k)
      reply = rig.macrostep(rig.velocity(frame));
    stopped += reply.fault.code == FaultCode::outside_workspace;
    rig.silence(10);
    for (const Axis a : kAxes) frame[a].velocity *= -0.5;
    EXPECT_EQ(rig.macrostep(rig.velocity(frame)).verdict, Verdict::executed);
  }
  EXPECT_EQ(stopped, 100);
}

TEST(GuardMotion, PoseOutsideTheWorkspaceIsRefusedWhateverTheInterpolation) {
  DriverParameters p = Rig::parameters();
  p.limits.workspace = Box{{-0.1, -0.1, 0}, {0.12, 0.1, 0.2}};
  for (const Interpolation mu : {Interpolation::mim, Interpolation::tcim_pose}) {
    Rig rig(p);
    rig.synchronise();
    ArmCommand a;
    a.mu = mu;
    a.n_s = a.n_Q = 1000;
    a.representation = Representation::xyz_angle_axis;
    a.pose = {0.05, 0.11, 0.1};
    const EffectorReply reply = rig.macrostep(rig.set_arm(a));
    EXPECT_EQ(reply.fault.code, FaultCode::outside_workspace);
    EXPECT_EQ(reply.fault.axis, 1);
    EXPECT_EQ(reply.fault.limit, 0.1);
  }
}

TEST(GuardMotion, ContactForceAboveItsLimitStopsMotionIntoTheContactAndNoOther) {
  for (const bool in_motors : {true, false}) {
    Rig rig;
    rig.synchronise();
    rig.world.stiffness[0] = 5000;  // 58 N after 11.6 mm
    const auto push = [&](double speed) {
      if (in_motors) return rig.jog({-400 * speed * 0.02}, 10);  // the motor turns against its joint
      return rig.velocity({u(speed), u(), u(), u(), u(), u()});
    };
    EffectorReply reply;
    for (int k = 0; k < 100 && reply.fault.code == FaultCode::none; ++k) reply = rig.macrostep(push(0.05));
    EXPECT_EQ(reply.fault.code, FaultCode::force_limit);
    EXPECT_EQ(reply.fault.axis, 0);
    EXPECT_GT(reply.fault.value, 58);
    EXPECT_LT(reply.fault.value, 59);
    rig.silence(10);
    EXPECT_EQ(rig.macrostep(push(0.05)).verdict, Verdict::failed);
    rig.silence(10);
    EXPECT_EQ(rig.macrostep(push(-0.05)).verdict, Verdict::executed) << "away from the contact";
  }
}

TEST(GuardMotion, ContactForceAboveItsLimitStopsTheArmAtOnce) {
  const double limit = Limits{}.contact_force[Axis::x];
  for (const bool in_motors : {true, false}) {
    Rig rig;
    rig.synchronise();
    rig.world.stiffness[0] = 5000;
    double peak = 0;
    rig.after_each_step = [&] { peak = std::max(peak, -rig.world.load()[Axis::x]); };
    const double speed = 0.3;  // 3 N per step
    for (int k = 0; k < 10 && rig.driver.fault().code == FaultCode::none; ++k)
      rig.macrostep(in_motors ? rig.jog({-400 * speed * 0.01}, 5)
                              : rig.velocity({u(speed), u(), u(), u(), u(), u()}, 5));
    rig.silence(10);
    EXPECT_EQ(rig.driver.state(), DriverState::holding);
    EXPECT_GT(peak, limit);
    EXPECT_LT(peak, limit + 3 * 3.1) << "the step in which it is seen, and what was on its way";
  }
}

TEST(GuardMotion, AStopAtOnceIsAsHardAsTheMotorsMayAndNoHarder) {
  DriverParameters p = Rig::parameters();
  p.limits.motor_acceleration = 5000;  // 0.02 rad more or less in a step
  const double most = p.limits.motor_acceleration * p.dt * p.dt;
  for (const bool in_motors : {true, false}) {
    Rig rig(p);
    rig.synchronise();
    rig.world.stiffness[0] = 5000;
    AxisVector before = AxisVector::Zero(FakeArm::kAxes);
    double worst = 0, fastest = 0;
    int braking = 0;
    rig.after_each_step = [&] {
      const AxisVector& now = rig.driver.set_point().motor_increment;
      worst = std::max(worst, (now - before).cwiseAbs().maxCoeff());
      braking += rig.driver.state() == DriverState::decelerating && !now.isZero(0);
      fastest = std::max(fastest, std::abs(now[0]));
      before = now;
    };
    // 0.0225 m/s, which are 0.018 rad a step, more from macrostep to macrostep, until it is 0.1 m/s.
    double speed = 0;
    for (int k = 0; k < 100 && rig.driver.fault().code == FaultCode::none; ++k) {
      speed = std::min(0.1, speed + 0.0225);
      rig.macrostep(in_motors ? rig.jog({-400 * speed * 0.002 * 5}, 5)
                              : rig.velocity({u(speed), u(), u(), u(), u(), u()}, 5));
    }
    ASSERT_EQ(rig.driver.fault().code, FaultCode::force_limit);
    EXPECT_NEAR(fastest, 0.08, 1e-3);
    rig.silence(10);
    EXPECT_EQ(rig.driver.state(), DriverState::holding);
    EXPECT_LE(worst, most * (1 + 1e-9));
    EXPECT_LE(braking, 4) << "0.08 rad in a step, 0.02 less each time";
    EXPECT_GE(braking, 2);
  }
}

TEST(GuardMotion, LimitsOfTheContactForceLieBelowTheRangeOfTheSensor) {
  for (const Axis a : kAxes)
    EXPECT_LT(Limits{}.contact_force[a], 0.95 * ForceSensorParameters{}.range[a]) << static_cast<int>(a);
}

TEST(GuardMotion, MotorMotionThatMovesTheTipTooFastIsBroughtToRest) {
  DriverParameters p = Rig::parameters();
  p.limits.linear_velocity = 0.3;
  Rig rig(p);
  rig.synchronise();
  EXPECT_EQ(rig.macrostep(rig.jog({0, 400 * 0.29 * 0.02}, 10)).verdict, Verdict::executed);
  rig.silence(10);
  EXPECT_EQ(rig.macrostep(rig.jog({0, 400 * 0.35 * 0.02}, 10)).verdict, Verdict::failed);
  EXPECT_EQ(rig.driver.reply().fault.code, FaultCode::too_fast);
  EXPECT_NEAR(rig.driver.reply().fault.value, 0.35 * 10 / 10.5, 1e-6) << "from rest it begins more slowly";
  EXPECT_EQ(rig.silence(10).state, DriverState::holding);
}

}  // namespace
}  // namespace mrroc::edp::test
