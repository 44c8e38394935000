// Excessive torque: a motion that a motor cannot make is a non-fatal error, and the arm stands where it is.
#include "edp/torque_watch.hpp"

#include <gtest/gtest.h>

#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

constexpr auto kLimited = static_cast<std::uint8_t>(AxisSwitch::current_limited);
constexpr double kDt = 0.002;  // [s]
constexpr int kAllowed = SupervisionParameters{}.torque_steps;

EffectorCommand sideways(Rig& rig) { return rig.velocity({u(0.02), u(), u(), u(), u(), u()}); }

/// Moves until a macrostep is not executed. @return its reply
EffectorReply move_on(Rig& rig, int macrosteps) {
  EffectorReply reply{};
  for (int k = 0; k < macrosteps; ++k) {
    reply = rig.macrostep(sideways(rig));
    if (reply.verdict != Verdict::executed) break;
  }
  return reply;
}

TEST(TorqueWatch, CountsStepsInSuccessionOfOneMotor) {
  const FakeArm arm;
  HardwareReading reading{};
  TorqueWatch watch(3);
  const auto step = [&](std::uint8_t switches, bool asked) {
    std::array<bool, kMaxAxes> all{};
    reading.switches[2] = switches;
    all[2] = asked;
    return watch.step(arm, reading, all, AxisVector::Zero(arm.axes()), kDt);
  };
  for (int k = 0; k < 3; ++k) EXPECT_FALSE(step(kLimited, false));
  EXPECT_FALSE(step(0, false));
  for (int k = 0; k < 3; ++k)
    EXPECT_FALSE(step(k == 1 ? std::uint8_t{} : kLimited, k == 1)) << "either of both";
  reading.current[2] = -7;
  const std::optional<Fault> fault = step(0, true);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::excessive_torque);
  EXPECT_EQ(fault->axis, 2);
  EXPECT_EQ(fault->value, 7);
  EXPECT_EQ(fault->limit, FakeArm::kCurrentLimit);
  EXPECT_EQ(class_of(fault->code), FaultClass::non_fatal);
  EXPECT_FALSE(step(kLimited, true)) << "it counts from the beginning";
}

TEST(TorqueWatch, AMotorThatGainsSpeedWithAllItsTorqueIsNotBlocked) {
  const FakeArm arm;
  const double full = arm.axis(1).max_motor_speed;
  for (const double sense : {1.0, -1.0})
    for (const double gain : {0.002, -0.03, 0.03}) {  // of the full speed, in a step, along the current
      HardwareReading reading{};
      reading.switches[1] = kLimited;
      reading.current[1] = 5 * sense;
      TorqueWatch watch(10);
      AxisVector increment = AxisVector::Zero(arm.axes());
      bool failed = false;
      for (int k = 0; k < 30; ++k) {
        failed |= watch.step(arm, reading, {}, increment, kDt).has_value();
        increment[1] += gain * full * sense * kDt * arm.axis(1).increments_per_rad;
      }
      EXPECT_EQ(failed, gain < 0.01) << gain << ' ' << sense;
    }
}

TEST(DriverTorque, AMotionAtTheLimitOfACurrentFailsAndTheArmStandsWhereItIs) {
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
    Rig rig;
    rig.synchronise();
    rig.macrostep(sideways(rig));
    rig.world.switches[k] = kLimited;
    rig.world.blocked.fill(true);
    const AxisVector there = rig.world.motors();
    const EffectorReply reply = move_on(rig, 10);
    EXPECT_EQ(reply.verdict, Verdict::failed);
    EXPECT_EQ(reply.fault.code, FaultCode::excessive_torque);
    EXPECT_EQ(reply.fault.axis, static_cast<int>(k));
    EXPECT_NE(rig.driver.state(), DriverState::faulted);
    EXPECT_LT((rig.driver.set_point().axes.motors - there).cwiseAbs().maxCoeff(), 2e-3)
        << "the set point does not stay ahead: what is in the way is relieved";
    rig.world.switches[k] = 0;
    rig.world.blocked.fill(false);
    EXPECT_EQ(rig.silence(1).state, DriverState::holding);
    EXPECT_EQ(rig.macrostep(sideways(rig)).verdict, Verdict::executed) << "no reset is needed";
  }
}

TEST(DriverTorque, AJumpOfTheVelocityMayTakeAllTorqueForAWhile) {
  Rig rig;
  rig.synchronise();
  int limited = 0;
  rig.after_each_step = [&] { rig.world.switches[1] = limited++ % (kAllowed + 1) < kAllowed ? kLimited : 0; };
  EXPECT_EQ(move_on(rig, 20).verdict, Verdict::executed);
  rig.after_each_step = nullptr;
  rig.world.switches[1] = kLimited;
  EXPECT_EQ(move_on(rig, 20).fault.code, FaultCode::excessive_torque);
}

TEST(DriverTorque, AnArmThatNobodyMovesMayBePushed) {
  Rig rig;
  rig.synchronise();
  rig.world.switches[3] = kLimited;
  EXPECT_FALSE(rig.silence(20).fault) << "ready";
  rig.world.switches[3] = 0;
  rig.macrostep(sideways(rig));
  rig.silence(10);
  rig.world.switches[3] = kLimited;
  EXPECT_FALSE(rig.silence(20).fault) << "holding";
}

TEST(DriverTorque, AJogBeforeHomingFailsLikewise) {
  Rig rig;
  rig.world.switches[0] = kLimited;
  const EffectorReply reply = rig.macrostep(rig.jog({0.5}));
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.fault.code, FaultCode::excessive_torque);
  EXPECT_EQ(rig.driver.state(), DriverState::not_synchronised);
}

}  // namespace
}  // namespace mrroc::edp::test
