// How a driver brings the arm to rest: when commands end, and before a limit.
#include <gtest/gtest.h>

#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {
namespace {

/// Watches the set motor positions for jumps.
class SetPointWatch {
 public:
  explicit SetPointWatch(Rig& rig) : rig_(rig), before_(rig.driver.set_point().axes.motors) {
    rig.after_each_step = [this] { look(); };
  }
  ~SetPointWatch() { rig_.after_each_step = nullptr; }
  SetPointWatch(const SetPointWatch&) = delete;
  SetPointWatch& operator=(const SetPointWatch&) = delete;

  AxisVector speed = AxisVector::Zero(FakeArm::kAxes);  ///< last increments [rad]
  double worst_acceleration{};  ///< largest change of an increment since start() [rad]
  int moving_steps{};           ///< steps since start() in which anything moved

  void start() {
    worst_acceleration = 0;
    moving_steps = 0;
  }

 private:
  void look() {
    const AxisVector& now = rig_.driver.set_point().axes.motors;
    const AxisVector increment = now - before_;
    worst_acceleration = std::max(worst_acceleration, (increment - speed).cwiseAbs().maxCoeff());
    moving_steps += (increment.array() != 0).any();
    speed = increment;
    before_ = now;
    // What the servo is told is what the set point does.
    EXPECT_LT((increment - rig_.driver.set_point().motor_increment).cwiseAbs().maxCoeff(), 1e-9);
  }
  Rig& rig_;
  AxisVector before_;
};

bool inside_limits(const Rig& rig) {
  const SetPoint& set = rig.driver.set_point();
  for (int k = 0; k < FakeArm::kAxes; ++k) {
    const AxisProperties& axis = rig.arm.axis(k);
    const double slack = 1e-6;
    if (set.axes.motors[k] < axis.motor.lower - slack || set.axes.motors[k] > axis.motor.upper + slack ||
        set.axes.joints[k] < axis.joint.lower - slack || set.axes.joints[k] > axis.joint.upper + slack)
      return false;
  }
  return true;
}

TEST(DriverStop, SilenceBringsEveryMotionSmoothlyToRestAndHolds) {
  std::mt19937_64 random(1);
  int moved = 0;
  for (int run = 0; run < 1000; ++run) {
    Rig rig;
    rig.synchronise();
    rig.world.stiffness.head<3>().setConstant(200);
    SetPointWatch watch(rig);
    for (int k = 0; k < 3; ++k)
      ASSERT_EQ(rig.macrostep(rig.set_arm(random_motion(random))).verdict, Verdict::executed);
    const std::int64_t end = rig.last.commanded_until;
    ASSERT_EQ(rig.world.reading().step, end);
    const double speed = watch.speed.cwiseAbs().maxCoeff();
    moved += speed > 0;
    watch.start();
    rig.macrostep();
    const bool still_moving = rig.driver.state() == DriverState::decelerating;
    EXPECT_TRUE(still_moving || speed == 0) << run;
    rig.silence(9);
    ASSERT_EQ(rig.driver.state(), DriverState::holding);
    ASSERT_EQ(rig.last.commanded_until, end);
    // Smoothstep: at most 1.5 times the mean deceleration; the axes are coupled by the kinematics.
    EXPECT_LT(watch.worst_acceleration, 1.5 / 40 * speed * 1.3 + 1e-4) << run;
    EXPECT_LT(watch.moving_steps, 40);
    const Pose rest = rig.driver.set_point().T_0E;
    const Pose arm_at_rest = rig.world.T_0E();
    rig.silence(20);
    EXPECT_EQ(rig.driver.set_point().T_0E.p, rest.p);
    EXPECT_LT((rig.world.T_0E().p - arm_at_rest.p).norm(), 1.2e-5) << "within 100 steps the arm is at rest";
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
  a.n_s = a.n_Q = 60;
  rig.macrostep(rig.set_arm(a));
  const AxisVector speed = rig.driver.set_point().motor_increment;
  int k = 0;
  rig.after_each_step = [&] {
    ++k;
    const AxisVector expected = k < 40 ? AxisVector(speed * remaining_speed(k, 40)) : AxisVector(0 * speed);
    EXPECT_LT((rig.driver.set_point().motor_increment - expected).cwiseAbs().maxCoeff(), 1e-12) << k;
  };
  rig.silence(5);
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
  rig.world.slip[0] = 3;  // what the brakes let through is made good
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

TEST(DriverStop, SetPointStopsBeforeEveryLimitOfJointsAndMotors) {
  std::mt19937_64 random(3);
  int failed = 0;
  int returned = 0;
  for (int run = 0; run < 300; ++run) {
    Rig rig;
    rig.synchronise();
    TaskFrameCommand frame{};
    const Vector3 v = 0.4 * random_direction(random);
    const Vector3 w = 1.5 * random_direction(random);
    // The tool turns too, so that motors reach their limits in the middle of a macrostep.
    frame = {u(v.x()), u(v.y()), u(v.z()), u(w.x()), u(w.y()), u(w.z())};
    if (run % 2) frame.ax = frame.ay = frame.az = u();
    EffectorReply reply{};
    for (int k = 0; k < 500 && rig.driver.state() != DriverState::holding; ++k) {
      SetPointWatch watch(rig);
      watch.speed = rig.driver.set_point().motor_increment;
      reply = rig.macrostep(rig.velocity(frame, 20));
      ASSERT_TRUE(inside_limits(rig)) << run;
      if (k > 0) {
        EXPECT_LT(watch.worst_acceleration, 0.12) << run << " " << to_string(rig.driver.fault().code);
      }
    }
    ASSERT_EQ(rig.driver.state(), DriverState::holding) << run;
    const FaultCode code = reply.fault.code;
    EXPECT_TRUE(code == FaultCode::joint_limit || code == FaultCode::unreachable_pose ||
                code == FaultCode::too_fast)
        << to_string(code);
    failed += reply.verdict == Verdict::failed || reply.verdict == Verdict::refused;
    // The way back is free, once the fault has been told.
    rig.silence(10);
    EXPECT_EQ(rig.driver.fault().code, FaultCode::none);
    const SetPoint& rest = rig.driver.set_point();
    if (std::abs(rest.axes.joints[4]) > 1.2) continue;  // near the wrist's singularity
    // The reach of this arm is not a limit of its joints, so that the motors' stop may lead out of it.
    if (rest.axes.joints.head<3>().norm() > FakeArm::kReach) continue;
    for (const Axis a : kAxes) frame[a].velocity *= -0.1;
    EXPECT_EQ(rig.macrostep(rig.velocity(frame)).verdict, Verdict::executed) << run;
    ++returned;
  }
  EXPECT_GT(returned, 200);
  EXPECT_EQ(failed, 300);
}

TEST(DriverStop, FailureAfterTheReplyIsToldBeforeAnythingMovesAgain) {
  Rig rig;
  rig.synchronise();
  ArmCommand a;
  a.frame.z = u(0.5);
  a.n_s = 500;
  a.n_Q = 1;
  EXPECT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed) << "it fails after its reply";
  EXPECT_EQ(rig.driver.fault().code, FaultCode::none);
  a.n_s = 90;  // ends before the limit, but so near that the stop would not fit
  EXPECT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::joint_limit);
  a.frame.z = u(-0.01);
  const EffectorReply told = rig.macrostep(rig.set_arm(a));
  EXPECT_EQ(told.verdict, Verdict::refused);
  EXPECT_EQ(told.fault.code, FaultCode::joint_limit);
  EXPECT_EQ(told.fault.axis, 2);
  rig.silence(4);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  EXPECT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
}

TEST(DriverStop, FailureThatIsOverBeforeItIsToldIsToldAllTheSame) {
  Rig rig;
  rig.synchronise();
  ArmCommand a;
  a.frame.z = c(5, 0, 0.1);  // 0.5 m/s in the air: the limit comes after the reply
  a.n_s = 1000;
  a.n_Q = 1;
  EXPECT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  const EffectorReply told = rig.macrostep();
  EXPECT_EQ(told.verdict, Verdict::none);
  EXPECT_EQ(told.fault.code, FaultCode::joint_limit);
  EXPECT_EQ(rig.macrostep().fault.code, FaultCode::none) << "once is enough";
}

TEST(DriverStop, SingularWristStopsTheTaskFrameAndMimLeadsOut) {
  Rig rig;
  rig.synchronise();
  ArmCommand a;
  a.mu = Interpolation::mim;
  a.representation = Representation::joints;
  a.pose = {0, 0, 0, 0, 1.45, 0};  // near pitch = pi/2
  a.n_s = 1000;
  a.n_Q = 1000;
  ASSERT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
  // Pitch over the singularity, slightly beside it: yaw and roll would have to turn by pi at once.
  EffectorReply reply{};
  for (int k = 0; k < 100 && reply.verdict != Verdict::failed && reply.verdict != Verdict::refused; ++k) {
    reply = rig.macrostep(rig.velocity({u(), u(), u(), u(0.002), u(0.5), u(0.02)}));
    EXPECT_LE(rig.driver.set_point().motor_increment.cwiseAbs().maxCoeff(), 0.5 + 1e-9);
  }
  EXPECT_NE(reply.verdict, Verdict::executed);
  rig.silence(6);
  EXPECT_EQ(rig.driver.state(), DriverState::holding);
  a.pose = {};
  EXPECT_EQ(rig.macrostep(rig.set_arm(a)).verdict, Verdict::executed);
}

TEST(DriverStop, ForceThatWouldDriveTheArmTooFastStopsIt) {
  Rig rig;
  rig.synchronise();
  rig.world.stiffness[0] = 1000;
  rig.world.T_0E_free.p.x() += 0.03;  // 30 N, and nothing resists: B = 1 asks for 30 m/s
  const EffectorReply reply = rig.macrostep(rig.velocity({c(0, 0, 1), u(), u(), u(), u(), u()}));
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.fault.code, FaultCode::too_fast);
  EXPECT_EQ(reply.fault.axis, 0);
  EXPECT_NEAR(rig.driver.set_point().T_0E.p.x(), Rig::parameters().T_WE.p.x(), 1e-9);
}

}  // namespace
}  // namespace mrroc::edp::test
