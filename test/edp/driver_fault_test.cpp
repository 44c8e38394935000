// Malfunctions: the drives brake, only reset leads on, from the measured pose.
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "edp/control_law.hpp"
#include "test/edp/rig.hpp"

namespace mrroc::edp::test {
namespace {

struct Malfunction {
  FaultCode code;
  int axis;
  std::function<void(Rig&)> begin;
  std::function<void(Rig&)> mend;
};

std::vector<Malfunction> malfunctions() {
  std::vector<Malfunction> all;
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
    const int axis = static_cast<int>(k);
    const auto press = [k](AxisSwitch s) {
      return [k, s](Rig& rig) { rig.world.switches[k] = static_cast<std::uint8_t>(s); };
    };
    const auto release = [k](Rig& rig) { rig.world.switches[k] = 0; };
    const auto nothing = [](Rig&) {};
    all.push_back({FaultCode::over_current, axis, press(AxisSwitch::over_current), release});
    all.push_back({FaultCode::limit_switch, axis, press(AxisSwitch::lower_limit), release});
    all.push_back({FaultCode::limit_switch, axis, press(AxisSwitch::upper_limit), release});
    all.push_back({FaultCode::over_speed, axis, [k](Rig& rig) { rig.world.slip[k] = 500; }, nothing});
    all.push_back({FaultCode::over_speed, axis, [k](Rig& rig) { rig.world.slip[k] = -500; }, nothing});
  }
  const double nan = std::numeric_limits<double>::quiet_NaN();
  all.push_back({FaultCode::sensor_silent, -1, [=](Rig& rig) { rig.world.sensor_offset.v.fill(nan); },
                 [](Rig& rig) { rig.world.sensor_offset = {}; }});
  all.push_back({FaultCode::force_not_finite, 3, [=](Rig& rig) { rig.world.sensor_offset[Axis::ax] = nan; },
                 [](Rig& rig) { rig.world.sensor_offset = {}; }});
  all.push_back({FaultCode::force_saturated, 1, [](Rig& rig) { rig.world.sensor_offset[Axis::y] = 70; },
                 [](Rig& rig) { rig.world.sensor_offset = {}; }});
  return all;
}

TEST(DriverFault, EveryMalfunctionBrakesTheDrivesAndNamesItsAxis) {
  for (const Malfunction& m : malfunctions()) {
    Rig rig;
    rig.synchronise();
    const EffectorCommand move = rig.velocity({u(0.05), u(), u(), u(), u(), u(0.1)});
    rig.macrostep(move);
    m.begin(rig);
    const EffectorReply reply = rig.macrostep(rig.velocity(move.arm.frame));
    EXPECT_EQ(reply.verdict, Verdict::failed) << to_string(m.code);
    EXPECT_EQ(reply.fault.code, m.code);
    EXPECT_EQ(reply.fault.axis, m.axis);
    EXPECT_EQ(class_of(reply.fault.code), FaultClass::fatal);
    EXPECT_EQ(reply.state, DriverState::faulted);
    EXPECT_FALSE(rig.last.enabled);
    EXPECT_EQ(rig.last.pwm, HardwareCommand{}.pwm);
    // It stays so until it is reset, and says so in every reply.
    m.mend(rig);
    EXPECT_EQ(rig.silence(10).fault.code, m.code);
    EXPECT_EQ(rig.macrostep(rig.velocity({})).fault.code, FaultCode::reset_required);
    EXPECT_EQ(rig.driver.state(), DriverState::faulted);
  }
}

TEST(DriverFault, TheNextReplyNamesTheCauseThoughItCameAfterTheReplyBefore) {
  Rig rig;
  rig.synchronise();
  rig.after_each_step = [&] {
    if (rig.driver.reply_due()) rig.world.switches[2] = static_cast<std::uint8_t>(AxisSwitch::over_current);
  };
  EXPECT_EQ(rig.macrostep(rig.velocity({u(0.01), u(), u(), u(), u(), u()})).verdict, Verdict::executed);
  rig.after_each_step = nullptr;
  const EffectorReply next = rig.macrostep(rig.velocity({}));
  EXPECT_EQ(next.verdict, Verdict::refused);
  EXPECT_EQ(next.fault.code, FaultCode::over_current);
  EXPECT_EQ(next.fault.axis, 2);
  EXPECT_EQ(rig.macrostep(rig.velocity({})).fault.code, FaultCode::reset_required);
}

TEST(DriverFault, ResetLeadsOnFromTheMeasuredPose) {
  for (const Malfunction& m : malfunctions()) {
    Rig rig;
    rig.synchronise();
    rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
    m.begin(rig);
    rig.macrostep();
    ASSERT_EQ(rig.driver.state(), DriverState::faulted);
    m.mend(rig);
    for (std::size_t k = 0; k < FakeArm::kAxes; ++k)
      rig.world.slip[k] = 200. * (k % 2 ? 1 : -1);  // pushed by hand
    rig.silence(2);
    EffectorCommand reset;
    reset.session = 99;  // an operator, not the owner
    reset.instruction = Instruction::reset;
    const EffectorReply reply = rig.macrostep(reset);
    EXPECT_EQ(reply.verdict, Verdict::executed);
    EXPECT_EQ(reply.state, DriverState::ready);
    EXPECT_TRUE(rig.last.enabled);
    EXPECT_LT((rig.driver.set_point().axes.motors - rig.world.motors()).cwiseAbs().maxCoeff(), 2e-3);
    EXPECT_EQ(rig.last.pwm, HardwareCommand{}.pwm) << "nothing jumps";
    EXPECT_FALSE(rig.driver.protocol().owner());
    rig.number = 0;  // a new session
    EXPECT_EQ(rig.macrostep(rig.velocity({u(0.01), u(), u(), u(), u(), u()})).verdict, Verdict::executed);
  }
}

TEST(DriverFault, ResetWhileTheCauseRemainsFailsWithIt) {
  Rig rig;
  rig.synchronise();
  rig.world.switches[4] = static_cast<std::uint8_t>(AxisSwitch::over_current);
  rig.macrostep();
  EffectorCommand reset;
  reset.instruction = Instruction::reset;
  const EffectorReply reply = rig.macrostep(reset);
  EXPECT_EQ(reply.verdict, Verdict::failed);
  EXPECT_EQ(reply.fault.code, FaultCode::over_current);
  EXPECT_EQ(reply.fault.axis, 4);
}

/// A rig that stands on a limit switch of axis 4 and has been reset.
struct OnSwitch : Rig {
  explicit OnSwitch(AxisSwitch which) {
    synchronise();
    world.switches[4] = static_cast<std::uint8_t>(which);
    macrostep();
    EffectorCommand reset;
    reset.instruction = Instruction::reset;
    EXPECT_EQ(macrostep(reset).state, DriverState::ready);
    number = 0;  // a new session
  }
};

TEST(DriverFault, AxisLeavesALimitSwitchAfterAResetInItsDirectionOnly) {
  for (const AxisSwitch which : {AxisSwitch::lower_limit, AxisSwitch::upper_limit}) {
    const double away = which == AxisSwitch::lower_limit ? 0.5 : -0.5;
    OnSwitch rig(which);
    EXPECT_EQ(rig.macrostep(rig.jog({0, 0, 0, 0, away})).verdict, Verdict::executed);
    rig.silence(6);
    EXPECT_EQ(rig.driver.state(), DriverState::holding) << "standing on the switch is no malfunction";

    OnSwitch other(which);
    const EffectorReply reply = other.macrostep(other.jog({0, 0, 0, 0, -away}));
    EXPECT_EQ(reply.fault.code, FaultCode::limit_switch);
    EXPECT_EQ(reply.fault.axis, 4);
    EXPECT_EQ(other.driver.state(), DriverState::faulted);
  }
}

TEST(DriverFault, LimitSwitchThatIsPressedAnewIsAMalfunctionAgain) {
  OnSwitch rig(AxisSwitch::lower_limit);
  rig.macrostep(rig.jog({0, 0, 0, 0, 0.5}));
  rig.world.switches[4] = 0;
  rig.silence(6);
  rig.world.switches[4] = static_cast<std::uint8_t>(AxisSwitch::lower_limit);
  rig.silence(1);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::limit_switch);
}

TEST(DriverFault, BlockedMotorIsAFollowingErrorOfItsAxis) {
  for (std::size_t k = 0; k < FakeArm::kAxes; ++k) {
    Rig rig;
    rig.synchronise();
    rig.world.blocked[k] = true;
    ArmCommand a;
    a.mu = Interpolation::mim;
    a.representation = Representation::motors;
    a.reference = Reference::relative;
    a.n_s = a.n_Q = 100;
    a.pose[k] = 3;
    const EffectorReply reply = rig.macrostep(rig.set_arm(a));
    EXPECT_EQ(reply.fault.code, FaultCode::following_error);
    EXPECT_EQ(reply.fault.axis, static_cast<int>(k));
    EXPECT_GT(std::abs(reply.fault.value), 1.5);
  }
}

TEST(DriverFault, OneBadReadingOfTheForceIsLeftOut) {
  Rig rig;
  rig.synchronise();
  rig.world.sensor_offset[Axis::z] = std::numeric_limits<double>::infinity();
  rig.step();
  rig.step();
  rig.world.sensor_offset = {};
  const EffectorReply reply = rig.macrostep();
  EXPECT_EQ(reply.state, DriverState::ready);
  EXPECT_NEAR(reply.F_a[Axis::z], 0, 1e-9);
}

TEST(DriverFault, EmergencyStopFromOutsideBrakesInTheNextStep) {
  Rig rig;
  rig.synchronise();
  rig.macrostep(rig.velocity({u(0.05), u(), u(), u(), u(), u()}));
  Fault stop;
  stop.code = FaultCode::emergency_stop;
  rig.driver.trip(stop);
  rig.step();
  EXPECT_FALSE(rig.last.enabled);
  EXPECT_EQ(rig.driver.fault().code, FaultCode::emergency_stop);
}

TEST(DriverFault, WhatIsRefusedUntilAResetNamesTheCauseAndItsAxis) {
  Rig rig;
  rig.synchronise();
  rig.world.switches[3] = static_cast<std::uint8_t>(AxisSwitch::over_current);
  rig.macrostep();
  const EffectorReply reply = rig.macrostep(rig.velocity({}));
  EXPECT_EQ(reply.fault.code, FaultCode::reset_required);
  EXPECT_EQ(reply.fault.axis, 3);
  EXPECT_EQ(reply.fault.text.view(), to_string(FaultCode::over_current));
}

TEST(DriverFault, ARefusalForAnotherReasonDoesNotCountAsTellingTheFault) {
  Rig rig;
  rig.synchronise();
  EXPECT_EQ(rig.macrostep(rig.motion_into_a_limit()).verdict, Verdict::executed);
  ASSERT_EQ(rig.driver.fault().code, FaultCode::joint_limit);
  EffectorCommand lost = rig.velocity({});
  lost.number += 5;
  EXPECT_EQ(rig.macrostep(lost).fault.code, FaultCode::lost_command);
  EXPECT_EQ(rig.macrostep().fault.code, FaultCode::joint_limit);
  EXPECT_EQ(rig.macrostep().fault.code, FaultCode::none);
}

TEST(DriverFault, OneReadingThatWasMissedDoublesTheTimeOfTheNextOne) {
  // In two steps this way is within the speed that is a fault, in one step it is not.
  for (const bool missed : {true, false}) {
    Rig rig;
    rig.synchronise();
    const AxisProperties& axis = rig.arm.axis(1);
    const double most = 1.25 * axis.max_motor_speed * axis.increments_per_rad * 0.002;
    HardwareReading reading = rig.world.reading();
    reading.encoder[1] += static_cast<std::int32_t>(1.6 * most);
    reading.step += missed ? 1 : 0;
    rig.driver.step(reading);
    EXPECT_EQ(rig.driver.fault().code, missed ? FaultCode::none : FaultCode::over_speed);
  }
}

TEST(DriverFault, MissedStepsAreNoOverSpeed) {
  // With the wall clock a reading may be missed: the increment is then that of two steps.
  Rig rig;
  rig.synchronise();
  for (int k = 0; k < 20; ++k) rig.macrostep(rig.velocity({u(0.45), u(), u(), u(), u(), u()}));
  ASSERT_EQ(rig.driver.state(), DriverState::executing);
  rig.world.apply(rig.last);
  rig.step();
  EXPECT_EQ(rig.driver.fault().code, FaultCode::none);
}

}  // namespace
}  // namespace mrroc::edp::test
