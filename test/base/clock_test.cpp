#include "base/clock.hpp"

#include <gtest/gtest.h>

namespace mrroc {
namespace {

using namespace std::chrono_literals;

/// Steps of 2 ms, each of which takes so long. @return how many were made until it is too slow, at most `most`
int steps_until_too_slow(PaceWatch& watch, PaceWatch::Time& now, std::chrono::microseconds each, int most) {
  for (int k = 0; k < most; ++k) {
    watch.step(now);
    if (watch.too_slow()) return k;
    now += each;
  }
  return most;
}

TEST(PaceWatch, ARunThatKeepsToTheClockOrNearlySoIsNeverTooSlow) {
  for (const auto each : {2000us, 2500us, 3300us}) {
    PaceWatch watch(0.002);
    PaceWatch::Time now{};
    EXPECT_EQ(steps_until_too_slow(watch, now, each, 20'000), 20'000) << each.count();
    EXPECT_NEAR(watch.speed(), 2000. / static_cast<double>(each.count()), 0.01);
  }
}

TEST(PaceWatch, ARunAtHalfTheSpeedIsToldAfterOneWindowOrTwo) {
  PaceWatch watch(0.002);
  PaceWatch::Time now{};
  steps_until_too_slow(watch, now, 2000us, 3000);  // 6 s: in the middle of a window
  const PaceWatch::Time before = now;
  steps_until_too_slow(watch, now, 4000us, 20'000);
  EXPECT_TRUE(watch.too_slow());
  EXPECT_LE(now - before, 2 * PaceWatch::kWindow + 10ms);
  EXPECT_LT(watch.speed(), PaceWatch::kSlowest);
}

TEST(PaceWatch, EveryWindowCountsItsOwnStepsAlsoBehindAnAbsence) {
  PaceWatch watch(0.002);
  PaceWatch::Time now{};
  for (const auto away : {0s, 1s, 2s}) {
    now += away;
    watch.step(now);
    for (int window = 0; window < 3; ++window) {
      for (int k = 0; k < 2000; ++k) watch.step(now += 2ms);
      EXPECT_DOUBLE_EQ(watch.speed(), 1) << "window " << window << " behind " << away.count() << " s";
    }
  }
}

TEST(PaceWatch, AProcessThatIsStoppedForAWhileIsNotSlow) {
  PaceWatch watch(0.002);
  PaceWatch::Time now{};
  for (const auto away : {400ms, 1000ms, 45'000ms}) {
    EXPECT_EQ(steps_until_too_slow(watch, now, 2000us, 1500), 1500) << away.count();
    now += away;
  }
  EXPECT_EQ(steps_until_too_slow(watch, now, 2000us, 1500), 1500);
}

}  // namespace
}  // namespace mrroc
