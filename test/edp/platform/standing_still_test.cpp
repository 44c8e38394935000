// What is found while a platform stands, to the number.
#include <gtest/gtest.h>

#include <cmath>

#include "edp/platform/synchronisation.hpp"

namespace mrroc::edp::test {
namespace {

constexpr PlatformProperties kPlatform{.name = "any", .increments_per_turn = 4000, .max_torque = 20};
constexpr double kDt = 0.002;
constexpr int kRest = 50;  // steps of 0.1 s

class StandingStillTest : public ::testing::Test {
 protected:
  StandingStillTest() {
    PlatformDriverParameters k;
    k.synchro_rest = kRest * kDt;
    k.synchro_timeout = 1;
    synchro.emplace(k, kDt);
    synchro->start();
    reading.encoder = {100, 200, 300, 400};
    reading.imu_valid = reading.load_valid = true;
    reading.yaw = 0.3;
    reading.yaw_rate = 0.01;
    reading.load = {10, 20, 30, 40};
  }
  void steps(int n) {
    for (int k = 0; k < n; ++k) {
      ++reading.step;
      sensors.measure(reading);
      synchro->step(sensors);
    }
  }
  void add(double x, double y, double phi) {
    synchro->add(
        {.step = reading.step, .valid = true, .p = {x, y, phi}, .covariance = {2, 1, 0, 1, 4, 0, 0, 0, 6}});
  }
  std::optional<StandingStill> found() { return synchro->found(sensors, 77); }
  FaultCode failure() {
    const auto fault = synchro->failed();
    return fault ? fault->code : FaultCode::none;
  }

  StageCollector sensors{kPlatform, kDt};
  std::optional<PlatformSynchronisation> synchro;
  PlatformReading reading;
};

TEST_F(StandingStillTest, IsTheMeanOfWhatWasMeasured) {
  steps(PlatformSynchronisation::kResetSteps);
  reading.yaw_rate = 0.03;
  reading.load = {30, 40, 50, 60};
  steps(24);
  reading.yaw_rate = 0.05;
  reading.load = {50, 60, 70, 80};
  steps(26);
  for (const double off : {0.0, 0.01, -0.01, 0.02, 0.03}) add(1 + off, 2 - off, 3.14 + 2 * off);
  const auto s = found();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->step, 77);
  EXPECT_NEAR(s->p.x, 1.01, 1e-12);
  EXPECT_NEAR(s->p.y, 1.99, 1e-12);
  EXPECT_NEAR(s->p.phi, 3.16 - 2 * M_PI, 1e-12) << "wrapped";
  EXPECT_NEAR(s->yaw_offset, 3.16 - 0.3, 1e-12);
  // Of 24 and 25 readings: those during the reset and the last one do not count.
  EXPECT_NEAR(s->gyro_bias, (24 * 0.03 + 25 * 0.05) / 49, 1e-12);
  EXPECT_NEAR(s->load[0], (24 * 30 + 25 * 50) / 49., 1e-9);
  EXPECT_NEAR(s->load[3], (24 * 60 + 25 * 80) / 49., 1e-9);
  EXPECT_NEAR(s->theta[2], 300 * 2 * M_PI / 4000, 1e-12);
  const PlanarCovariance wanted{0.4, 0.2, 0, 0.2, 0.8, 0, 0, 0, 1.2};
  for (std::size_t k = 0; k < wanted.size(); ++k) EXPECT_NEAR(s->covariance[k], wanted[k], 1e-12) << k;
  EXPECT_EQ(failure(), FaultCode::none);
}

TEST_F(StandingStillTest, WhatIsMeasuredAfterwardsDoesNotCount) {
  steps(kRest + PlatformSynchronisation::kResetSteps);
  reading.yaw_rate = 9;
  reading.load = {900, 900, 900, 900};
  steps(40);
  for (int k = 0; k < 5; ++k) add(1, 2, 3);
  ASSERT_TRUE(found());
  EXPECT_NEAR(found()->gyro_bias, 0.01, 1e-12);
  EXPECT_NEAR(found()->load[0], 10, 1e-9);
}

TEST_F(StandingStillTest, TakesItsTimeAndFivePositions) {
  steps(kRest + PlatformSynchronisation::kResetSteps - 1);
  for (int k = 0; k < 5; ++k) add(1, 2, 3);
  EXPECT_FALSE(found()) << "a step is missing";
  steps(1);
  EXPECT_TRUE(found());
  reading.imu_valid = false;
  steps(1);
  EXPECT_FALSE(found()) << "a yaw is needed";
  reading.imu_valid = true;
  steps(1);
  EXPECT_TRUE(found());
  synchro->start();
  steps(kRest + PlatformSynchronisation::kResetSteps);
  for (int k = 0; k < 4; ++k) add(1, 2, 3);
  EXPECT_FALSE(found()) << "those of before are forgotten";
  add(1, 2, 3);
  EXPECT_TRUE(found());
}

TEST_F(StandingStillTest, PositionsBeginAnewWithOneThatDoesNotAgree) {
  const auto found_after = [&](double x, double y, double phi) {
    synchro->start();
    steps(kRest + PlatformSynchronisation::kResetSteps);
    for (int k = 0; k < 4; ++k) add(1, 2, 3);
    add(1 + x, 2 + y, 3 + phi);
    return found().has_value();
  };
  EXPECT_TRUE(found_after(0.07, -0.07, -0.0999));
  EXPECT_TRUE(found_after(0, 0, 2 * M_PI));
  EXPECT_FALSE(found_after(0.0715, 0.0715, 0)) << "0.101 m";
  EXPECT_FALSE(found_after(-0.101, 0, 0));
  EXPECT_FALSE(found_after(0, 0, 0.101));
  EXPECT_FALSE(found_after(0, 0, -0.101));
  for (int k = 0; k < 3; ++k) add(1, 2, 2.9);
  EXPECT_FALSE(found());
  add(1, 2, 2.9);
  ASSERT_TRUE(found());
  EXPECT_NEAR(found()->p.phi, 2.8992, 0.01);
  EXPECT_NEAR(found()->p.x, 1, 1e-12);
  EXPECT_NEAR(found()->covariance[0], 0.4, 1e-12);
}

TEST_F(StandingStillTest, PositionsOfBeforeItStoodAreNotUsed) {
  add(1, 2, 3);
  steps(1);
  const std::int64_t since = reading.step;
  steps(kRest + PlatformSynchronisation::kResetSteps);
  for (int k = 0; k < 6; ++k)
    synchro->add({.step = since - 1, .valid = true, .p = {1, 2, 3}, .covariance = {}});
  EXPECT_FALSE(found());
  for (int k = 0; k < 5; ++k) synchro->add({.step = since, .valid = true, .p = {1, 2, 3}, .covariance = {}});
  EXPECT_TRUE(found());
}

TEST_F(StandingStillTest, AWheelMayMoveByItsPlayAndNotMore) {
  steps(1);
  EXPECT_TRUE(synchro->resets_imu());
  steps(1);
  EXPECT_FALSE(synchro->resets_imu());
  reading.encoder[3] += 2;
  steps(1);
  reading.encoder[3] -= 4;
  steps(1);
  EXPECT_FALSE(synchro->resets_imu());
  reading.encoder[3] -= 1;
  steps(1);
  EXPECT_TRUE(synchro->resets_imu()) << "three from where it stood";
  steps(kRest);
  reading.encoder[0] += 2;
  steps(1);
  EXPECT_FALSE(synchro->resets_imu()) << "counted from where it stands now";
  for (int k = 0; k < 5; ++k) add(1, 2, 3);
  reading.encoder[0] += 1;
  steps(1);
  EXPECT_TRUE(synchro->resets_imu());
  steps(kRest + PlatformSynchronisation::kResetSteps - 1);
  EXPECT_FALSE(found()) << "positions of before";
}

TEST_F(StandingStillTest, HalfOfTheReadingsAreEnough) {
  const auto failure_after = [&](int absent, bool PlatformReading::*what) {
    synchro->start();
    reading.*what = true;
    steps(PlatformSynchronisation::kResetSteps);
    reading.*what = false;
    steps(absent);
    reading.*what = true;
    steps(kRest - absent);
    return synchro->failed();
  };
  for (const auto what : {&PlatformReading::imu_valid, &PlatformReading::load_valid}) {
    EXPECT_FALSE(failure_after(24, what));
    const auto fault = failure_after(25, what);
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->code, FaultCode::sensor_silent);
    EXPECT_EQ(fault->axis, -1);
    EXPECT_EQ(fault->value, 24);
    EXPECT_EQ(fault->limit, 25);
  }
}

TEST_F(StandingStillTest, AWheelWithoutLoadIsNoWheelAtRest) {
  for (const double load : {0.0, -5.0}) {
    synchro->start();
    reading.load = {10, 20, load, 40};
    steps(kRest + PlatformSynchronisation::kResetSteps);
    const auto fault = synchro->failed();
    ASSERT_TRUE(fault);
    EXPECT_EQ(fault->code, FaultCode::sensor_silent);
    EXPECT_EQ(fault->axis, 2);
    EXPECT_EQ(fault->value, load);
    for (int k = 0; k < 5; ++k) add(1, 2, 3);
    EXPECT_FALSE(found());
  }
}

TEST_F(StandingStillTest, FailsAtItsTimeoutWithWhatIsMissing) {
  steps(499);
  EXPECT_EQ(failure(), FaultCode::none);
  for (int k = 0; k < 3; ++k) add(1, 2, 3);
  steps(1);
  auto fault = synchro->failed();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::position_unknown);
  EXPECT_EQ(fault->axis, -1);
  EXPECT_EQ(fault->value, 3);
  EXPECT_EQ(fault->limit, PlatformSynchronisation::kPoses);
  synchro->start();
  for (int k = 0; k < 500; ++k) {
    reading.encoder[1] += k % 20 == 0 ? 5 : 0;
    steps(1);
  }
  fault = synchro->failed();
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->code, FaultCode::position_unknown);
  EXPECT_EQ(fault->axis, -1);
  EXPECT_EQ(fault->value, 20);
  EXPECT_EQ(fault->limit, kRest);
}

}  // namespace
}  // namespace mrroc::edp::test
