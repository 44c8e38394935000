#include "base/task_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace mrroc {
namespace {

TEST(TaskClock, GoesOnByAMacrostepInEveryMacrostepWithoutAPause) {
  TaskClock clock = TaskClock::ramped();
  for (int i = 0; i < 1000; ++i) {
    clock.advance(false);
    EXPECT_EQ(clock.now().time, i);
    EXPECT_EQ(clock.now().pace, 1);
    EXPECT_FALSE(clock.paused());
  }
}

TEST(TaskClock, SlowsDownToStandstillInItsMacrostepsAndComesBackInAsMany) {
  for (const int ramp : {1, 4, 10, 100}) {
    TaskClock clock = TaskClock::ramped(ramp);
    for (int k = 1; k <= 2 * ramp; ++k) {
      clock.advance(true);
      EXPECT_NEAR(clock.now().pace, std::max(0.0, 1 - static_cast<double>(k) / ramp), 1e-12);
      EXPECT_TRUE(clock.paused());
    }
    const double stands = clock.now().time;
    for (int k = 0; k < 50; ++k) clock.advance(true);
    EXPECT_EQ(clock.now().time, stands);
    for (int k = 1; k <= ramp; ++k) clock.advance(false);
    EXPECT_NEAR(clock.now().pace, 1, 1e-12);
    EXPECT_FALSE(clock.paused());
  }
}

TEST(TaskClock, PausesAtAnyTimesTakeNothingFromTaskTimeButThePauses) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    TaskClock clock = TaskClock::ramped();
    double sum = 0, before = 0;
    bool paused = false;
    for (int i = 0; i < 2000; ++i) {
      if (random() % 20 == 0) paused = !paused;
      clock.advance(paused);
      EXPECT_NEAR(clock.now().time, sum, 1e-9);
      EXPECT_LE(std::abs(clock.now().pace - before), i == 0 ? 1.0 : 0.1 + 1e-12) << "never a jump";
      EXPECT_GE(clock.now().pace, 0);
      EXPECT_LE(clock.now().pace, 1);
      before = clock.now().pace;
      sum += before;
    }
  }
}

TEST(TaskClock, AtASafeRowGoesOnUntilItComesAndStandsInItAtOnce) {
  constexpr int kSafe = 11;
  TaskClock clock = TaskClock::at_safe_row(kSafe);
  clock.advance(false, 3);
  for (int k = 0; k < 20; ++k) {
    clock.advance(true, 3);
    EXPECT_EQ(clock.now().pace, 1);
    EXPECT_TRUE(clock.now().paused) << "the task knows of it";
    EXPECT_FALSE(clock.paused()) << "the operator is not told yet";
  }
  clock.advance(true, kSafe);
  EXPECT_EQ(clock.now().pace, 0);
  EXPECT_TRUE(clock.paused());
  clock.advance(false, kSafe);
  EXPECT_EQ(clock.now().pace, 1);
  EXPECT_FALSE(clock.paused());
}

}  // namespace
}  // namespace mrroc
