#include "edp/deceleration.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edp/approach.hpp"

namespace mrroc::edp {
namespace {

TEST(Deceleration, SpeedFallsFromAllToNothingAndNeverRises) {
  for (int n = 1; n <= kMaxStopSteps; ++n) {
    EXPECT_EQ(remaining_speed(0, n), 1);
    EXPECT_EQ(remaining_speed(n, n), 0);
    EXPECT_EQ(speed_ratio(n, n), 0);
    for (int k = 1; k <= n; ++k) EXPECT_LT(remaining_speed(k, n), remaining_speed(k - 1, n));
  }
}

TEST(Deceleration, AccelerationHasNoStep) {
  const int n = kMaxStopSteps;
  double before = 0;
  for (int k = 1; k <= n + 1; ++k) {
    const double acceleration = k <= n ? remaining_speed(k, n) - remaining_speed(k - 1, n) : 0;
    EXPECT_LE(std::abs(acceleration), 1.5 / n + 1e-12);
    EXPECT_LE(std::abs(acceleration - before), 6.0 / (n * n) + 1e-12);
    before = acceleration;
  }
}

TEST(Deceleration, RatiosMultiplyToTheRemainingSpeed) {
  double speed = 1;
  for (int k = 1; k <= 40; ++k) {
    speed *= speed_ratio(k, 40);
    EXPECT_NEAR(speed, remaining_speed(k, 40), 1e-15);
  }
}

TEST(Deceleration, StoppingWayIsTheSumOfAllSteps) {
  for (int n = 1; n <= kMaxStopSteps; ++n) {
    double way = 0;
    for (int k = 1; k <= n; ++k) way += remaining_speed(k, n);
    EXPECT_NEAR(stopping_way(n), way, 1e-12);
  }
}

TEST(Deceleration, WaysOfAStopAreTheSumsOfItsSpeeds) {
  for (int n = 1; n <= kMaxStopSteps; ++n)
    for (int k = 0; k <= n + 1; ++k) {
      double way = 0, left = 0;
      for (int j = 1; j <= n; ++j) (j <= k ? way : left) += remaining_speed(j, n);
      if (k <= n) {
        EXPECT_NEAR(way_of_stop(k, n), way, 1e-12) << k << ' ' << n;
      }
      EXPECT_NEAR(remaining_way(k, n), k < n ? left / remaining_speed(k, n) : 0, 1e-9) << k << ' ' << n;
      EXPECT_TRUE(k < n || remaining_way(k, n) == 0);
    }
}

TEST(Deceleration, AMotionThatBrakesBeforeItsGoalReachesItHalfAStopAfterItsMacrostepRoundedDown) {
  for (int n_s = 1; n_s <= 500; ++n_s)
    for (int n = 1; n <= std::min(2 * n_s, kMaxStopSteps); ++n)
      EXPECT_EQ(Approach(n_s, n).steps(), n_s + n / 2) << n_s << ' ' << n;
}

}  // namespace
}  // namespace mrroc::edp
