#include "edp/servo.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "edp/encoders.hpp"
#include "edp/supervision.hpp"
#include "test/edp/fake_arm.hpp"

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
  Servo servo(arm);
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
