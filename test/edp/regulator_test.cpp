// The original's regulator by itself: what it remembers, and how it takes over.
#include "edp/regulator.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrroc::edp {
namespace {

constexpr RegulatorCoefficients kCoefficients{.epsilon = 0.01, .a = 0.4, .b0 = 1.5, .b1 = 1.45};

/// A regulator that has seen random motions.
IncrementalRegulator used(unsigned seed) {
  IncrementalRegulator regulator(kCoefficients);
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<> increment(-3, 3);
  for (int k = 0; k < 50; ++k) regulator.step(increment(random), increment(random));
  return regulator;
}

void expect_alike(IncrementalRegulator one, IncrementalRegulator other) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<> increment(-3, 3);
  for (int k = 0; k < 50; ++k) {
    const double set = increment(random), measured = increment(random);
    ASSERT_EQ(one.step(set, measured), other.step(set, measured)) << k;
  }
}

TEST(IncrementalRegulator, TakesOverAlikeWhateverItHasDoneBefore) {
  IncrementalRegulator fresh(kCoefficients), old = used(1);
  fresh.resume(4, -1, 30);
  old.resume(4, -1, 30);
  expect_alike(fresh, old);
}

TEST(IncrementalRegulator, ForgetsEverythingWhenItIsReset) {
  IncrementalRegulator old = used(2);
  old.reset();
  expect_alike(IncrementalRegulator(kCoefficients), old);
}

TEST(IncrementalRegulator, GoesOnWithTheDutyCycleThatItFindsWhereNothingIsBehind) {
  IncrementalRegulator regulator = used(3);
  regulator.resume(0, 0, 42);
  for (int k = 0; k < 20; ++k) EXPECT_NEAR(regulator.step(1, 1), 42, 1e-9) << "the shaft does as it is told";
}

// A shaft that turns with a speed per duty cycle, some steps later: the loop's own plant.
TEST(IncrementalRegulator, MakesUpForAnErrorThatItTakesOverAndForOneThatIsPushedIn) {
  for (const double error : {-20., 0., 15.}) {
    IncrementalRegulator regulator(kCoefficients);
    regulator.resume(error, 0, 0);
    double behind = error, speed = 0;
    for (int k = 0; k < 4000; ++k) {
      const double moved = speed + (k == 1000 ? 5 : 0);  // a push
      behind -= moved;
      speed += 0.04 * (0.1 * regulator.step(0, moved) - speed);
    }
    EXPECT_NEAR(behind, 0, 0.1) << error;
  }
}

TEST(IncrementalRegulator, StaysWithinTheLargestDutyCycleAndComesBackFromThere) {
  IncrementalRegulator regulator(kCoefficients);
  for (int k = 0; k < 100; ++k) EXPECT_LE(regulator.step(50, 0), kMaxPwm);
  EXPECT_EQ(regulator.step(50, 0), kMaxPwm);
  for (int k = 0; k < 200; ++k) EXPECT_GE(regulator.step(-50, 0), -kMaxPwm);
  EXPECT_EQ(regulator.step(-50, 0), -kMaxPwm);
}

}  // namespace
}  // namespace mrroc::edp
