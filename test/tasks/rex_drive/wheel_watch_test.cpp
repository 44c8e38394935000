// What wheels say against a motion that was seen.
#include "tasks/rex_drive/wheel_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "test/tasks/rex_drive/images.hpp"

namespace mrroc::rex_drive {
namespace {

/// Wheels that turn evenly. @param speed  [rad/s]
WheelWatch turning(double speed, std::int64_t from = 0, std::int64_t to = 200) {
  WheelWatch watch;
  for (std::int64_t step = from; step <= to; step += 10) {
    const double theta = speed * 0.002 * static_cast<double>(step);
    watch = watched(watch, wheels_at(step, {theta, -theta, theta, -theta}));
  }
  return watch;
}

OdometryReading reading(double x, double turn) {
  OdometryReading r{.step_before = 80, .step = 120, .valid = true};
  r.A = {std::cos(turn), -std::sin(turn), 0, x, std::sin(turn), std::cos(turn), 0, 0, 0, 0, 1, 0};
  return r;
}

TEST(WheelWatch, ContradictsPicturesThatStandWhileTheWheelsTurn) {
  // 80 ms at 1 rad/s are 0.08 rad.
  EXPECT_TRUE(stands_against_wheels(reading(0, 0), turning(1)));
  EXPECT_TRUE(stands_against_wheels(reading(0.0009, 0.0009), turning(-4)));
  EXPECT_FALSE(stands_against_wheels(reading(0, 0), turning(0.7))) << "0.056 rad: the beginning of a start";
  EXPECT_FALSE(stands_against_wheels(reading(0, 0), turning(0))) << "at rest";
}

TEST(WheelWatch, DoesNotContradictAMotion) {
  for (const double speed : {0.0, 1.0, 8.0}) {
    EXPECT_FALSE(stands_against_wheels(reading(0.0011, 0), turning(speed)));
    EXPECT_FALSE(stands_against_wheels(reading(-0.0011, 0), turning(speed)));
    EXPECT_FALSE(stands_against_wheels(reading(0, 0.0011), turning(speed)));
    EXPECT_FALSE(stands_against_wheels(reading(0, -0.0011), turning(speed)));
  }
}

TEST(WheelWatch, SaysNothingOfWhatItDoesNotReachBackTo) {
  EXPECT_FALSE(stands_against_wheels(reading(0, 0), {}));
  EXPECT_FALSE(stands_against_wheels(reading(0, 0), turning(5, 90)));
  EXPECT_FALSE(stands_against_wheels(reading(0, 0), turning(5, 0, 110))) << "its end is not known";
  OdometryReading none = reading(0, 0);
  none.valid = false;
  EXPECT_FALSE(stands_against_wheels(none, turning(5)));
}

TEST(WheelWatch, KeepsTheNewestEstimatesEachOnce) {
  WheelWatch watch = turning(1, 0, 1000);
  EXPECT_EQ(watch.size(), 25U);
  EXPECT_EQ(watch.back().step, 1000);
  EXPECT_EQ(watch.front().step, 760);
  watch = watched(watch, wheels_at(1000, {}));
  watch = watched(watch, wheels_at(500, {}));
  EXPECT_EQ(watch.size(), 25U);
  EXPECT_NE(watch.back().theta[0], 0);
}

}  // namespace
}  // namespace mrroc::rex_drive
