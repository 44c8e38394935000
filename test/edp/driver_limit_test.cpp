// A driver brings the arm to rest before a limit, at a singularity and above its speed, and tells the
// failure once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "test/edp/random_command.hpp"
#include "test/edp/set_point_watch.hpp"

namespace mrroc::edp::test {
namespace {

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

TEST(DriverStop, AStopInTheTaskFrameBesideALimitStaysWithinItAndStaysSmooth) {
  std::mt19937_64 random(8);
  double hardest = 0;
  int beside = 0;
  for (int run = 0; run < 300; ++run) {
    // The tool turns, so that the motors go on otherwise in the stop than the last step says.
    const Vector3 v = 0.3 * random_direction(random);
    const Vector3 w = 1.9 * random_direction(random);
    const TaskFrameCommand frame{u(v.x()), u(v.y()), u(v.z()), u(w.x()), u(w.y()), u(w.z())};
    int last = 0;  // macrosteps until the limit is near
    for (Rig rig; last < 1000; ++last) {
      if (last == 0) rig.synchronise();
      if (rig.macrostep(rig.velocity(frame, 2)).verdict != Verdict::executed) break;
    }
    Rig rig;
    rig.synchronise();
    for (int k = 0; k < last - 1; ++k) rig.macrostep(rig.velocity(frame, 2));
    if (rig.driver.state() != DriverState::executing) continue;
    if (std::abs(rig.driver.set_point().axes.joints[4]) > 1.2) continue;  // near the wrist's singularity
    SetPointWatch watch(rig);
    watch.speed = rig.driver.set_point().motor_increment;
    const double speed = watch.speed.cwiseAbs().maxCoeff();
    watch.start();
    for (int k = 0; k < 10; ++k) {
      rig.silence(1);
      ASSERT_TRUE(inside_limits(rig)) << run;
    }
    ASSERT_EQ(rig.driver.state(), DriverState::holding) << run;
    hardest = std::max(hardest, watch.worst_acceleration / speed);
    ++beside;
  }
  EXPECT_GT(beside, 100);
  EXPECT_LT(hardest, 0.06) << "of the speed, in a step: 1.5/40 in a straight line";
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
  EXPECT_EQ(rig.macrostep(rig.motion_into_a_limit()).verdict, Verdict::executed);
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
