// Periods of a robot with a clock of its own: which are late, which are skipped, and when the host is too slow.
#include "edp/period_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc::edp {
namespace {

using namespace std::chrono_literals;
using Time = PeriodClock::Time;

constexpr double kDt = 0.002;

TEST(PeriodClock, PeriodsBeginWithoutDriftHoweverLateTheyAre) {
  PeriodClock clock(kDt);
  const Time begun{1h};
  std::mt19937_64 random(1);
  EXPECT_EQ(clock.begin(0, clock.due(0, begun)), 0);
  for (std::int64_t n = 1; n < 10'000; ++n) {
    ASSERT_EQ(clock.due(n, Time{}) - begun, n * 2ms);
    ASSERT_EQ(clock.begin(n, clock.due(n, Time{}) + std::chrono::microseconds(random() % 1999)), n);
  }
  EXPECT_EQ(clock.late().periods, 10'000);
  EXPECT_EQ(clock.late().skipped, 0);
  EXPECT_GT(clock.late().late, 7'000) << "three quarters were more than the tolerance late";
  EXPECT_NEAR(clock.late().worst, 0.002, 1e-4);
  EXPECT_FALSE(clock.too_slow());
}

TEST(PeriodClock, ALatePeriodIsCountedAndTheWorstIsKept) {
  PeriodClock clock(kDt);
  const Time begun{1h};
  clock.begin(5, begun);
  EXPECT_EQ(clock.begin(6, begun + 2ms + PeriodClock::kTolerance), 6) << "not late yet";
  EXPECT_EQ(clock.late().late, 0);
  EXPECT_EQ(clock.begin(7, begun + 4ms + 1500us), 7);
  EXPECT_EQ(clock.begin(8, begun + 6ms + 600us), 8);
  EXPECT_EQ(clock.late().late, 2);
  EXPECT_NEAR(clock.late().worst, 0.0015, 1e-9);
}

TEST(PeriodClock, WholePeriodsThatWereMissedAreSkippedAndTheNextOneIsInTime) {
  PeriodClock clock(kDt);
  const Time begun{1h};
  clock.begin(0, begun);
  EXPECT_EQ(clock.begin(1, begun + 2ms + 7ms), 4) << "it begins in period 4";
  EXPECT_EQ(clock.late().skipped, 3);
  EXPECT_EQ(clock.begin(5, begun + 10ms), 5);
  EXPECT_EQ(clock.late().late, 1);
}

TEST(PeriodClock, ACommandAfterTheEndOfItsPeriodIsAnOverrun) {
  PeriodClock clock(kDt);
  const Time begun{1h};
  clock.begin(0, begun);
  clock.end(begun + 2ms);
  EXPECT_EQ(clock.late().overruns, 0);
  clock.begin(1, begun + 2ms);
  clock.end(begun + 4001us);
  EXPECT_EQ(clock.late().overruns, 1);
}

TEST(PeriodClock, AHostThatMissesHalfOfThePeriodsIsTooSlow) {
  PeriodClock clock(kDt);
  const Time begun{1h};
  std::int64_t n = 0;
  for (Time now = begun; now < begun + 2 * PaceWatch::kWindow; now += 4ms) n = clock.begin(n, now) + 1;
  EXPECT_TRUE(clock.too_slow());
  EXPECT_NEAR(clock.pace(), 0.5, 0.01);
}

}  // namespace
}  // namespace mrroc::edp
