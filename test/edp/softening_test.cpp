#include "edp/softening.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::edp {
namespace {

constexpr double kDt = 0.002;
const AxisSet kAll("111111");

/// Feeds swings of 12 Hz about 5 N along z. @return whether z was ever softened
bool swing(Softening& softening, double size, double seconds, AxisSet watched = kAll) {
  bool softened = false;
  for (int k = 0; k * kDt < seconds; ++k) {
    Wrench F;
    F[Axis::z] = 5 + size / 2 * std::sin(2 * std::numbers::pi * 12 * k * kDt);
    softened |= softening.step(F, watched).any();
  }
  return softened;
}

TEST(Softening, LeavesTheLawItsShareOfSpeedAndTheForceAtWhichItSettles) {
  std::mt19937_64 random(1);
  const auto drawn = [&](double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  };
  for (int run = 0; run < 1000; ++run) {
    TaskFrameCommand rows;
    rows.x = c(drawn(-10, 10), drawn(1, 50), drawn(1e-4, 0.02));
    rows.y = g(drawn(-0.1, 0.1), drawn(1, 50), drawn(1e-4, 0.02));
    rows.z = u(drawn(-0.1, 0.1));
    MobilityShares shares{1, 1, 1, 1, 1, 1};
    const double s = shares[0] = shares[1] = shares[2] = drawn(0.01, 1);
    const TaskFrameCommand soft = softened(rows, shares);
    const double F = drawn(-20, 20), v = drawn(-0.1, 0.1);
    for (const Axis a : {Axis::x, Axis::y}) {
      EXPECT_NEAR(axis_velocity(soft[a], F, s * v, kDt), s * axis_velocity(rows[a], F, v, kDt), 1e-12);
      EXPECT_NEAR(settled_force(soft[a]), settled_force(rows[a]), 1e-9);
    }
    EXPECT_EQ(soft.z, rows.z) << "force does not act on it";
  }
}

TEST(Softening, HalvesTheMobilityOfTheAxisThatSwingsAndOfNoOther) {
  Softening softening({}, kDt);
  EXPECT_TRUE(swing(softening, 1.2, 0.3));
  EXPECT_EQ(softening.shares()[2], 0.5);
  for (const std::size_t other : {0, 1, 3, 4, 5}) EXPECT_EQ(softening.shares()[other], 1);
}

TEST(Softening, GoesDownToTheLeastShareAndSaysNothingThere) {
  Softening softening({.softest = 0.125}, kDt);
  EXPECT_TRUE(swing(softening, 3, 5));
  EXPECT_EQ(softening.shares()[2], 0.125);
  EXPECT_FALSE(swing(softening, 3, 1)) << "now it is for the observer of unstable contacts";
  Softening none({.softest = 1}, kDt);
  EXPECT_FALSE(swing(none, 3, 5));
  EXPECT_EQ(none.shares()[2], 1);
}

TEST(Softening, IsNotForSwingsOfLessThanHalfOfWhatAFaultNeeds) {
  Softening softening({}, kDt);
  EXPECT_FALSE(swing(softening, 0.9, 5));
}

TEST(Softening, EndsWhereForceDoesNotActAnyMoreAndByAndByWithoutContact) {
  Softening softening({}, kDt);
  swing(softening, 1.2, 0.3);
  ASSERT_EQ(softening.shares()[2], 0.5);
  for (int k = 0; k * kDt < 0.5; ++k) softening.step({}, kAll);
  EXPECT_NEAR(softening.shares()[2], 0.5 * std::sqrt(2), 1e-2);
  for (int k = 0; k * kDt < 1; ++k) softening.step({}, kAll);
  EXPECT_EQ(softening.shares()[2], 1);

  swing(softening, 1.2, 0.3);
  softening.step({}, {});
  EXPECT_EQ(softening.shares()[2], 1);
}

}  // namespace
}  // namespace mrroc::edp
