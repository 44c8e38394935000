#include "robots/rex/stage_window.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// A window that stands still from step 0 on.
class StageWindowTest : public testing::Test {
 protected:
  StageWindowTest() { window.begin({.p = {}, .load = standing_load(44, {0.04, 0, 0})}); }

  static edp::StageReading reading(std::int64_t step) {
    return {.step = step, .imu_valid = true, .load = standing_load(44, {0.04, 0, 0})};
  }
  static MapPose map(std::int64_t step) {
    return {.step = step, .valid = true, .p = {}, .covariance = {1e-4, 0, 0, 0, 1e-4, 0, 0, 0, 1e-4}};
  }
  static OdometryReading odometry(std::int64_t before, std::int64_t step) {
    OdometryReading motion{.step_before = before, .step = step, .valid = true};
    motion.A = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
    return motion;
  }
  void fill(int stages) {
    for (int i = 0; i < stages; ++i) ASSERT_EQ(window.add(reading(window.newest().step + 10)), Entry::next);
  }

  StageWindow window{EstimatorNoise{}};
};

TEST_F(StageWindowTest, KeepsTheLastStages) {
  fill(100);
  EXPECT_TRUE(window.full());
  EXPECT_EQ(window.size(), kWindowStages);
  for (int k = 0; k < kWindowStages; ++k) EXPECT_EQ(window[k].step, 1000 - 10 * (kWindowStages - 1 - k));
}

TEST_F(StageWindowTest, IgnoresWhatIsNotNewerAndStartsAgainBehindAGap) {
  fill(5);
  EXPECT_EQ(window.add(reading(50)), Entry::repeated);
  EXPECT_EQ(window.add(reading(30)), Entry::repeated);
  EXPECT_EQ(window.add(reading(std::numeric_limits<std::int64_t>::min())), Entry::repeated);
  EXPECT_EQ(window.size(), 6);
  EXPECT_EQ(window.add(reading(65)), Entry::restart);
  EXPECT_EQ(window.size(), 1);
  EXPECT_EQ(window.add(reading(std::numeric_limits<std::int64_t>::max())), Entry::restart);
}

TEST_F(StageWindowTest, TakesMapPosesOfItsStagesOnly) {
  fill(30);
  EXPECT_EQ(window.add(map(100)), 0);
  EXPECT_EQ(window.add(map(300)), 20);
  EXPECT_EQ(window.add(map(99)), -1);
  EXPECT_EQ(window.add(map(301)), -1);
  EXPECT_EQ(window.add(map(std::numeric_limits<std::int64_t>::min())), -1);
  EXPECT_EQ(window.add(map(std::numeric_limits<std::int64_t>::max())), -1);
}

TEST_F(StageWindowTest, PutsMapPosesBetweenStagesToTheNearestOne) {
  fill(30);
  EXPECT_EQ(window.add(map(203)), 10);
  EXPECT_NEAR(window[10].map_delay, 0.006, 1e-12);
  EXPECT_EQ(window.add(map(207)), 11);
  EXPECT_NEAR(window[11].map_delay, -0.006, 1e-12);
  EXPECT_EQ(window.add(map(299)), 20);
  EXPECT_NEAR(window[20].map_delay, -0.002, 1e-12);
}

TEST_F(StageWindowTest, RefusesWhatIsNoMapPose) {
  fill(30);
  const auto refused = [&](const auto& change) {
    MapPose pose = map(200);
    change(pose);
    return window.add(pose) < 0;
  };
  EXPECT_TRUE(refused([](MapPose& p) { p.valid = false; }));
  EXPECT_TRUE(refused([](MapPose& p) { p.p.x = kNan; }));
  EXPECT_TRUE(refused([](MapPose& p) { p.p.y = 1e300; }));
  EXPECT_TRUE(refused([](MapPose& p) { p.covariance[0] = -1e-4; }));
  EXPECT_TRUE(refused([](MapPose& p) { p.covariance[4] = kNan; }));
  EXPECT_TRUE(refused([](MapPose& p) { p.covariance[1] = p.covariance[3] = 1; }));
  EXPECT_FALSE(refused([](MapPose&) {}));
}

TEST_F(StageWindowTest, TakesMotionsBetweenTwoOfItsStages) {
  fill(30);
  EXPECT_EQ(window.add(odometry(100, 140)), 0);
  EXPECT_TRUE(window[0].picture);
  EXPECT_EQ(window.add(odometry(140, 180)), 4);
  EXPECT_TRUE(window[8].odometry.valid);
  EXPECT_EQ(window.add(odometry(140, 180)), 4) << "the same again";
  EXPECT_EQ(window.add(odometry(90, 140)), -1) << "older than the window";
  EXPECT_EQ(window.add(odometry(260, 310)), -1) << "newer than the window";
  EXPECT_EQ(window.add(odometry(205, 240)), -1) << "not a stage";
  EXPECT_EQ(window.add(odometry(240, 200)), -1) << "back in time";
  EXPECT_EQ(window.add(odometry(200, 200)), -1);
  EXPECT_EQ(window.add(odometry(120, 180)), -1) << "reaches over another picture";
  EXPECT_EQ(window.add(odometry(160, 200)), -1) << "its picture is within another motion";
}

TEST_F(StageWindowTest, RefusesWhatIsNoMotion) {
  fill(30);
  OdometryReading motion = odometry(200, 240);
  motion.A[3] = kNan;
  EXPECT_EQ(window.add(motion), -1);
  motion = odometry(200, 240);
  motion.covariance[35] = kNan;
  EXPECT_EQ(window.add(motion), -1);
  motion = odometry(200, 240);
  motion.valid = false;
  EXPECT_EQ(window.add(motion), -1);
  for (int k = 0; k < window.size(); ++k) EXPECT_FALSE(window[k].picture);
}

TEST_F(StageWindowTest, TakesThePlanarPartOfAMotionAndItsCovariance) {
  fill(30);
  OdometryReading motion = odometry(200, 240);
  motion.A = {std::cos(0.1), -std::sin(0.1), 0, 0.03, std::sin(0.1), std::cos(0.1), 0, 0.02, 0, 0, 1, 9};
  motion.covariance[0] = 1e-4;
  motion.covariance[7] = 4e-4;
  motion.covariance[5] = motion.covariance[30] = 1e-5;
  motion.covariance[35] = 9e-4;
  const int picture = window.add(motion);
  ASSERT_EQ(picture, 10);
  const PlanarFactor& factor = window[14].odometry;
  EXPECT_NEAR(factor.value[0], 0.03, 1e-12);
  EXPECT_NEAR(factor.value[1], 0.02, 1e-12);
  EXPECT_NEAR(factor.value[2], 0.1, 1e-12);
  Eigen::Matrix3d expected;
  expected << 1e-4, 0, 1e-5, 0, 4e-4, 0, 1e-5, 0, 9e-4;
  EXPECT_LT((factor.covariance - expected).norm(), 1e-15);
  EXPECT_LT((factor.whitening * expected * factor.whitening.transpose() - Eigen::Matrix3d::Identity()).norm(),
            1e-9);
}

TEST_F(StageWindowTest, NoMeasurementIsTakenForMoreCertainThanItCanBe) {
  fill(30);
  MapPose pose = map(200);
  pose.covariance = {};
  ASSERT_EQ(window.add(pose), 10);
  EXPECT_DOUBLE_EQ(std::sqrt(window[10].map.covariance(0, 0)), EstimatorNoise{}.map_position);
  ASSERT_EQ(window.add(odometry(200, 240)), 10);
  EXPECT_DOUBLE_EQ(std::sqrt(window[14].odometry.covariance(2, 2)), EstimatorNoise{}.odometry_heading);
}

TEST_F(StageWindowTest, AMotionIsBelievedToAShareOfItsLengthAsACalibrationMayBeOff) {
  constexpr EstimatorNoise kNoise;
  fill(30);
  for (const double length : {0., 0.005, 0.05, 0.2}) {
    OdometryReading reading = odometry(200, 240);
    reading.covariance = {};
    reading.A[3] = 0.6 * length;
    reading.A[7] = -0.8 * length;
    ASSERT_EQ(window.add(reading), 10);
    const double least = std::hypot(kNoise.odometry_position, kNoise.odometry_scale * length);
    for (const int axis : {0, 1})
      EXPECT_NEAR(std::sqrt(window[14].odometry.covariance(axis, axis)), least, 1e-12) << length;
    EXPECT_NEAR(std::sqrt(window[14].odometry.covariance(2, 2)), kNoise.odometry_heading, 1e-12) << length;
  }
}

TEST_F(StageWindowTest, WithoutAMapTheYawFollowsTheHeadingThatExactPicturesHaveLedTo) {
  fill(80);  // the map was there at step 0, at 800 it has been gone for more than a second
  ASSERT_EQ(window.add(odometry(700, 740)), 10);
  window.see_heading(10, 0.05);
  const double offset = window.yaw_offset();
  EXPECT_NEAR(offset, 0.1 * 0.05, 1e-12);
  OdometryReading rough = odometry(740, 780);
  rough.covariance[35] = 1e-6;
  ASSERT_EQ(window.add(rough), 14);
  window.see_heading(14, 0.05);
  EXPECT_EQ(window.yaw_offset(), offset) << "pictures in which there is little to see";
  ASSERT_GE(window.add(map(760)), 0);
  const double by_map = window.yaw_offset();
  EXPECT_LT(by_map, offset);
  ASSERT_EQ(window.add(odometry(780, 800)), 18);
  window.see_heading(18, 0.05);
  EXPECT_EQ(window.yaw_offset(), by_map) << "the map is there";
}

TEST_F(StageWindowTest, WhatCannotBeMeasuredIsNoMeasurement) {
  edp::StageReading bad = reading(10);
  bad.theta[1] = kNan;
  bad.theta_dot[1] = kNan;
  bad.yaw = kNan;
  bad.load[2] = kNan;
  bad.torque[3] = kNan;
  ASSERT_EQ(window.add(bad), Entry::next);
  EXPECT_FALSE(window.newest().wheels_valid);
  EXPECT_FALSE(window.newest().imu_valid);
  EXPECT_FALSE(window.newest().torque_known);
  EXPECT_TRUE(window.newest().torque.isZero());
  EXPECT_TRUE(window.newest().theta.isZero());
  EXPECT_NEAR(window.newest().load.sum(), 44 * kGravity, 1e-9);
  ASSERT_EQ(window.add(reading(20)), Entry::next);
  EXPECT_TRUE(window.newest().wheels_valid);
  edp::StageReading fast = reading(30);
  fast.theta_dot[0] = 100;
  ASSERT_EQ(window.add(fast), Entry::next);
  EXPECT_FALSE(window.newest().wheels_valid);
}

TEST_F(StageWindowTest, GyroBiasIsTakenAway) {
  window.begin({.p = {}, .gyro_bias = 0.02});
  edp::StageReading now = reading(10);
  now.yaw_rate = 0.5;
  ASSERT_EQ(window.add(now), Entry::next);
  EXPECT_NEAR(window.newest().yaw_rate, 0.48, 1e-12);
}

// The offset follows what the map says, but slowly, and from outliers it hardly moves.
TEST_F(StageWindowTest, YawOffsetIsDrawnSlowlyToTheMap) {
  fill(30);
  MapPose pose = map(200);
  pose.p.phi = 0.05;
  ASSERT_EQ(window.add(pose), 10);
  EXPECT_GT(window.yaw_offset(), 0.0005);
  EXPECT_LT(window.yaw_offset(), 0.0015);
  for (int i = 0; i < 300; ++i) ASSERT_EQ(window.add(pose), 10);
  EXPECT_NEAR(window.yaw_offset(), 0.05, 0.001);
  pose.p.phi = -3;
  ASSERT_EQ(window.add(pose), 10);
  EXPECT_NEAR(window.yaw_offset(), 0.05, 0.004);
}

}  // namespace
}  // namespace mrroc::rex::test
