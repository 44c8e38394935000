// The servo of a motor, its regulators and encoders, and the supervision of the drives.
#include "edp/servo.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "edp/encoders.hpp"
#include "edp/supervision.hpp"
#include "test/edp/fake_arm.hpp"
#include "test/edp/one_motor.hpp"

namespace mrroc::edp::test {
namespace {

TEST(Regulator, FollowsItsDifferenceEquation) {
  // Worked by hand: epsilon 0.1, a 0.5, b0 2, b1 1; e = 1, 0.
  IncrementalRegulator r({.epsilon = 0.1, .a = 0.5, .b0 = 2, .b1 = 1});
  EXPECT_NEAR(r.step(3, 2), 2 * 1.1, 1e-12);
  // delta = 1.1 - 0.9 = 0.2; u = 1.5 * 2.2 + 2 * 0.2 - 1.1
  EXPECT_NEAR(r.step(2, 2), 1.5 * 2.2 + 0.4 - 1.1, 1e-12);
}

TEST(Regulator, OutputIsClippedAndResetForgets) {
  IncrementalRegulator r({.epsilon = 0, .a = 0, .b0 = 1, .b1 = 0});
  for (int k = 0; k < 10; ++k) EXPECT_LE(r.step(1e6, 0), kMaxPwm);
  r.reset();
  EXPECT_EQ(r.step(0, 0), 0);
}

TEST(Servo, FractionsOfAnIncrementAreNotLost) {
  // A hundredth of an increment per step: after 1000 steps the shaft has turned by ten.
  const FakeArm arm;
  Servo servo(arm, 0.002);
  const double increment = 0.01 / arm.axis(2).increments_per_rad;
  AxisVector set = AxisVector::Zero(FakeArm::kAxes);
  set[2] = increment;
  AxisVector measured = AxisVector::Zero(FakeArm::kAxes);
  double shaft = 0;
  for (int k = 0; k < 1000; ++k) {
    const double before = std::floor(shaft);
    const auto pwm = servo.step(set, measured, AxisVector::Zero(FakeArm::kAxes));
    EXPECT_EQ(pwm[0], 0) << "the other motors have nothing to do";
    shaft += 2 * pwm[2];
    measured[2] = std::floor(shaft) - before;
  }
  EXPECT_NEAR(shaft, 10, 1);
}

/// Both sets of algorithm 0 are the same, and their output depends on nothing that an exchange forgets.
AxisProperties equal_sets() {
  AxisProperties axis;
  axis.increments_per_rad = 1;
  axis.servo.incremental.fill({.epsilon = 0.1, .a = 0, .b0 = 2, .b1 = 1.5});
  axis.servo.compensating.fill({.bandwidth = 100, .observer = 150});
  axis.servo.drive = {.resistance = 2, .inertia = 3e-4};
  return axis;
}

/// A servo of OneMotor, in numbers.
struct OneServo {
  double step(double set, double measured, double gravity_feed_forward = 0) {
    return servo.step(AxisVector::Constant(1, set), AxisVector::Constant(1, measured),
                      AxisVector::Constant(1, gravity_feed_forward))[0];
  }
  void braked(double measured) { servo.braked(AxisVector::Constant(1, measured)); }

  OneMotor robot{equal_sets()};
  Servo servo{robot, 0.002};
};

TEST(Servo, BrakesThatOpenLeaveTheKnownWeightToTheMotorInTheFirstStep) {
  for (const double torque : {0.05, -0.2}) {
    OneServo one;
    ASSERT_TRUE(one.servo.select(0, 1, 0));
    one.braked(0);
    EXPECT_NEAR(one.step(0, 0, torque), torque * one.robot.axis(0).servo.drive.pwm_per_torque(), 1e-9)
        << "else the arm sags until the observer has seen it";
  }
}

TEST(Servo, ARegulatorThatIsExchangedForItsLikeGoesOnAsIfNothingHadHappened) {
  std::mt19937_64 random(4);
  OneServo plain, exchanged;
  plain.servo.select(0, 0, 0);
  exchanged.servo.select(0, 0, 0);
  for (int k = 0; k < 500; ++k) {
    const double set = 1 + static_cast<double>(random() % 5), measured = static_cast<double>(random() % 7);
    if (k > 0 && random() % 3 == 0)
      exchanged.servo.select(0, 0, 1 - exchanged.servo.selected(0).parameter_set_no);
    ASSERT_NEAR(exchanged.step(set, measured), plain.step(set, measured), 1e-9) << k;
  }
}

TEST(Servo, TheRegulatorThatIsAtWorkMayBeChosenAgainAndGoesOn) {
  for (const int algorithm : {0, 1}) {
    OneServo plain, chosen;
    for (OneServo* const one : {&plain, &chosen}) ASSERT_TRUE(one->servo.select(0, algorithm, 1));
    for (int k = 0; k < 50; ++k) {
      EXPECT_TRUE(chosen.servo.select(0, algorithm, 1));
      ASSERT_EQ(chosen.step(1, k % 3), plain.step(1, k % 3)) << algorithm << ' ' << k;
    }
  }
}

TEST(Servo, ARegulatorThatIsChosenWhileTheBrakesHoldKnowsThatTheMotorStands) {
  OneServo one;
  one.servo.select(0, 1, 0);
  one.step(0, 5);
  const double pwm = one.step(5, 0);  // the shaft is where it is set to be, and both were moving
  one.braked(0);
  ASSERT_TRUE(one.servo.select(0, 0, 0));
  for (int k = 0; k < 5; ++k) EXPECT_NEAR(one.step(0, 0), pwm, 1e-9) << "nothing moves: nothing to answer";
}

TEST(Encoders, MotorIsWhereItWasPlusWhatItTurned) {
  const FakeArm arm;
  Encoders encoders(arm);
  HardwareReading reading{};
  AxisVector known(FakeArm::kAxes);
  for (int k = 0; k < FakeArm::kAxes; ++k) {
    known[k] = 3 * k - 5;
    reading.encoder[static_cast<std::size_t>(k)] = 1000 * k - 77;
  }
  encoders.synchronise(reading, known);
  EXPECT_EQ(encoders.motors(reading), known);
  reading.encoder[4] += 4000;  // one turn
  AxisVector expected = known;
  expected[4] += 2 * std::numbers::pi;
  EXPECT_LT((encoders.motors(reading) - expected).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Encoders, ANewZeroOfAMotorTakesThePlaceOfTheOldOne) {
  const FakeArm arm;
  Encoders encoders(arm);
  HardwareReading reading{};
  reading.encoder[2] = 500;
  encoders.synchronise(reading, AxisVector::Constant(FakeArm::kAxes, 0.3));
  AxisVector expected = encoders.motors(reading);
  expected[2] = -0.7;
  for (int again = 0; again < 2; ++again) {
    encoders.set_zero(2, 500, -0.7);
    EXPECT_EQ(encoders.motors(reading), expected) << "other motors stay where they are";
  }
}

TEST(Encoders, CounterThatWrapsAroundIsNoJump) {
  HardwareReading reading{};
  std::array<std::int32_t, kMaxAxes> before{};
  before[1] = std::numeric_limits<std::int32_t>::max() - 2;
  reading.encoder[1] = std::numeric_limits<std::int32_t>::min() + 2;
  EXPECT_EQ(Encoders::difference(reading, before, 1), 5);
}

class Supervision : public testing::Test {
 protected:
  std::optional<Fault> look() { return supervise_drives(arm, rules, reading, drives); }
  FakeArm arm;
  SupervisionParameters rules{.over_speed = 1.2, .following_error = 2};
  HardwareReading reading{};
  DriveObservation drives{
      AxisVector::Zero(6), AxisVector::Zero(6), AxisVector::Zero(6), 0.002, AxisVector::Zero(6), 0};
};

TEST_F(Supervision, NothingIsWrongUpToTheLimits) {
  EXPECT_FALSE(look());
  drives.increment[3] = -1.199 * 250 * 0.002 * arm.axis(3).increments_per_rad;
  drives.set[5] = -1.99;
  reading.switches[2] = static_cast<std::uint8_t>(AxisSwitch::synchro);
  EXPECT_FALSE(look());
}

TEST_F(Supervision, CurrentIsJudgedAsMeasuredAndBySwitch) {
  reading.current[2] = -FakeArm::kMaxCurrent;
  EXPECT_FALSE(look());
  for (const double current : {FakeArm::kMaxCurrent + 0.1, -FakeArm::kMaxCurrent - 0.1, std::nan("")}) {
    reading.current[2] = current;
    const std::optional<Fault> fault = look();
    ASSERT_TRUE(fault) << current;
    EXPECT_EQ(fault->code, FaultCode::over_current);
    EXPECT_EQ(fault->axis, 2);
    EXPECT_EQ(fault->limit, FakeArm::kMaxCurrent);
  }
  reading.current[2] = 0;
  reading.switches[4] = static_cast<std::uint8_t>(AxisSwitch::over_current);
  const std::optional<Fault> fault = look();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::over_current);
  EXPECT_EQ(fault->axis, 4);
}

TEST_F(Supervision, SpeedIsJudgedByTheTimeThatPassed) {
  drives.increment[3] = 1.3 * 250 * 0.002 * arm.axis(3).increments_per_rad;
  const std::optional<Fault> fault = look();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::over_speed);
  EXPECT_EQ(fault->axis, 3);
  EXPECT_NEAR(fault->value, 325, 1e-9);
  EXPECT_NEAR(fault->limit, 300, 1e-9);
  EXPECT_EQ(fault->text.view(), "yaw");
  drives.time = 0.004;
  EXPECT_FALSE(look());
}

TEST_F(Supervision, FollowingErrorHasTheSignOfWhatIsMissing) {
  drives.set[1] = 3;
  drives.measured[1] = 5.5;
  const std::optional<Fault> fault = look();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::following_error);
  EXPECT_NEAR(fault->value, -2.5, 1e-12);
}

}  // namespace
}  // namespace mrroc::edp::test
