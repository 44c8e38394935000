// When arms have come to rest, and how long they took.
#include "sim/rest_watch.hpp"

#include <gtest/gtest.h>

namespace mrroc::sim {
namespace {

constexpr double kMoving = 0.1;  // [m/s]

/// Steps 0..last, of which those from `first` to `until` are moved in.
void move(RestWatch& watch, int arm, std::int64_t first, std::int64_t until, std::int64_t last,
          std::int64_t commanded_until) {
  for (std::int64_t step = 0; step <= last; ++step)
    watch.step(arm, step, step >= first && step < until ? kMoving : 0, 0, commanded_until);
}

TEST(RestWatch, CountsFromTheLastCommandToTheLastStepOfMotion) {
  RestWatch watch;
  move(watch, 0, 0, 530, 700, 500);
  EXPECT_EQ(watch.stop_steps(400), (std::array{30, -1, -1, -1})) << "the arm obeys commands, not the stop";
  move(watch, 1, 0, 200, 700, 500);
  EXPECT_EQ(watch.stop_steps(400), (std::array{30, 0, -1, -1}))
      << "one that rests before has stopped at once";
}

TEST(RestWatch, AnArmThatMovesByItselfIsCountedFromTheStop) {
  RestWatch watch;
  constexpr std::int64_t kLong = 2 * RestWatch::kLongestStop;
  move(watch, 0, 0, kLong + 40, kLong + 300, 100);
  EXPECT_EQ(watch.stop_steps(kLong)[0], 40);
}

TEST(RestWatch, AToolThatOnlyTurnsIsNotAtRest) {
  RestWatch watch;
  for (std::int64_t step = 0; step < 700; ++step)
    watch.step(0, step, 0, (step < 560 ? 2 : 0.5) * RestWatch::kRestTurn, 500);
  EXPECT_TRUE(watch.at_rest());
  EXPECT_EQ(watch.stop_steps(400)[0], 60);
  watch.step(0, 700, 0, 2 * RestWatch::kRestTurn, 500);
  EXPECT_FALSE(watch.at_rest());
}

TEST(RestWatch, RestsOnceEveryArmHasBeenStillForLongEnough) {
  RestWatch watch;
  std::int64_t step = 0;
  for (; step < 50; ++step) watch.step(0, step, kMoving, 0, 10);
  while (!watch.at_rest()) {
    ASSERT_LT(step, 50 + 2 * RestWatch::kSettled);
    watch.step(0, step++, RestWatch::kRestSpeed / 2, RestWatch::kRestTurn / 2, 10);
  }
  EXPECT_EQ(step, 50 + RestWatch::kSettled + 1);
  watch.step(0, step, kMoving, 0, 10);
  EXPECT_FALSE(watch.at_rest());
}

}  // namespace
}  // namespace mrroc::sim
