// Homing of one axis step by step, with switches that a test presses.
#include <gtest/gtest.h>

#include "edp/homing.hpp"
#include "test/edp/fake_arm.hpp"

namespace mrroc::edp::test {
namespace {

constexpr double kDt = 0.002;
constexpr std::size_t kAxis = 2;  // the first one

class HomingSteps : public testing::Test {
 protected:
  HomingSteps() : homing(arm, parameters(), kDt) { homing.start(); }

  static HomingParameters parameters() {
    HomingParameters p;
    p.first_axis = kAxis;
    p.ramp_steps = 4;
    p.standstill_steps = 7;
    p.settle_steps = 9;
    for (AxisHoming& axis : p.axis) {
      axis.coarse = 100;
      axis.fine = 5;
    }
    return p;
  }
  void press(AxisSwitch which, bool pressed = true) {
    auto& bits = reading.switches[kAxis];
    bits = static_cast<std::uint8_t>(pressed ? bits | static_cast<unsigned>(which)
                                             : bits & ~static_cast<unsigned>(which));
  }
  /// One step. @return motion of the first axis in it [rad]
  double step() {
    const std::optional<Fault> wrong = homing.step(reading);
    if (wrong) fault = *wrong;
    return homing.increment()[kAxis];
  }
  /// @return steps until the motion is as wanted, at most 10000
  template <class Wanted>
  int steps_until(Wanted wanted) {
    int steps = 1;
    while (!wanted(step()) && !fault && steps < 10'000) ++steps;
    return steps;
  }
  /// Goes to the switch. It is believed with the second reading.
  void find_switch() {
    for (int k = 0; k < 20; ++k) step();
    press(AxisSwitch::synchro);
    step();
    step();
  }
  /// Goes on until the switch has been left and is believed to be.
  void leave_switch() {
    steps_until([](double x) { return x > 0; });
    press(AxisSwitch::synchro, false);
    step();
    step();
  }

  FakeArm arm;
  Homing homing;
  HardwareReading reading{};
  Fault fault{};
};

TEST_F(HomingSteps, TheSpeedGrowsEvenlyToTheCoarseOneTowardsTheSwitch) {
  steps_until([](double x) { return x != 0; });
  for (int k = 2; k <= 4; ++k) EXPECT_NEAR(step(), -100 * kDt * k / 4, 1e-12);
  for (int k = 0; k < 10; ++k) EXPECT_NEAR(step(), -100 * kDt, 1e-12);
}

TEST_F(HomingSteps, AnAxisThatBeginsOnTheSwitchLeavesItFirst) {
  press(AxisSwitch::synchro);
  for (int k = 0; k < 30; ++k) EXPECT_GE(step(), 0) << k;
  EXPECT_NEAR(step(), 100 * kDt, 1e-12);
  press(AxisSwitch::synchro, false);
  step();
  step();
  EXPECT_LT(steps_until([](double x) { return x < 0; }), 10) << "and comes back";
}

TEST_F(HomingSteps, TheAxisStandsOnTheSwitchForItsStepsAndLeavesItSlowly) {
  find_switch();
  EXPECT_EQ(steps_until([](double x) { return x == 0; }), 4) << "from the coarse speed";
  EXPECT_EQ(steps_until([](double x) { return x > 0; }), 7 + 1);
  step();
  EXPECT_NEAR(step(), 5 * kDt, 1e-12);
}

TEST_F(HomingSteps, TheZeroMarkBehindTheSwitchIsTakenAndTheAxisSettles) {
  find_switch();
  press(AxisSwitch::index);
  reading.index[kAxis] = 111;  // one that comes on the switch is none
  leave_switch();
  press(AxisSwitch::index, false);
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(step(), 5 * kDt, 1e-12);
  press(AxisSwitch::index);
  reading.index[kAxis] = 4321;
  step();
  press(AxisSwitch::index, false);
  reading.index[kAxis] = 9999;
  int steps = 0;
  while (homing.axis() == static_cast<int>(kAxis) && steps < 1000) {
    step();
    ++steps;
  }
  EXPECT_EQ(steps, 9);
  EXPECT_EQ(homing.axis(), static_cast<int>(kAxis) + 1);
  EXPECT_EQ(homing.count(kAxis), 4321);
  EXPECT_FALSE(homing.done());
  EXPECT_EQ(fault.code, FaultCode::none);
}

TEST_F(HomingSteps, AHomingKnowsNothingOfTheOneBefore) {
  for (const std::int32_t mark : {4321, 77}) {
    homing.start();
    reading = {};
    find_switch();
    leave_switch();
    press(AxisSwitch::index);
    reading.index[kAxis] = mark;
    step();
    EXPECT_EQ(homing.count(kAxis), mark);
  }
}

TEST_F(HomingSteps, ASwitchThatLetsGoWhileTheAxisStandsIsNone) {
  find_switch();
  press(AxisSwitch::synchro, false);
  steps_until([](double) { return false; });
  EXPECT_EQ(fault.code, FaultCode::synchro_switch_missing);
  EXPECT_EQ(fault.axis, static_cast<int>(kAxis));
}

TEST_F(HomingSteps, ALimitSwitchSaysThatTheSearchMissedTheSwitchOrThatItSticks) {
  for (const AxisSwitch limit : {AxisSwitch::lower_limit, AxisSwitch::upper_limit})
    for (const bool searching : {true, false}) {
      homing.start();
      reading = {};
      fault = {};
      press(AxisSwitch::synchro, !searching);
      for (int k = 0; k < 20; ++k) step();
      EXPECT_EQ(fault.code, FaultCode::none);
      press(limit);
      EXPECT_EQ(step(), 0) << "it stands";
      EXPECT_EQ(fault.code, searching ? FaultCode::synchro_switch_missing : FaultCode::synchro_switch_stuck);
      EXPECT_GT(fault.value, 0) << "the way gone";
    }
}

TEST_F(HomingSteps, NoWayIsLongerThanTheRangeOfTheMotor) {
  const Range& legal = arm.axis(kAxis).motor;
  const double range = legal.upper - legal.lower;
  for (const bool on_switch : {true, false}) {
    homing.start();
    reading = {};
    fault = {};
    press(AxisSwitch::synchro, on_switch);
    steps_until([](double) { return false; });
    EXPECT_EQ(fault.code, on_switch ? FaultCode::synchro_switch_stuck : FaultCode::synchro_switch_missing);
    EXPECT_DOUBLE_EQ(fault.limit, range);
    EXPECT_GT(fault.value, range);
    EXPECT_LT(fault.value, range + 2 * 100 * kDt);
  }
}

}  // namespace
}  // namespace mrroc::edp::test
