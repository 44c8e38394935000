#include "robots/rex/weighing.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex::test {
namespace {

double uniform(std::mt19937& random, double from, double to) {
  return std::uniform_real_distribution<>(from, to)(random);
}

void expect_empty(const Load& load) {
  EXPECT_EQ(load.mass, kMass);
  EXPECT_EQ(load.centre.x, 0);
  EXPECT_EQ(load.centre.y, 0);
  for (const double N : load.wheel) EXPECT_DOUBLE_EQ(N, kMass * kGravity / 4);
}

TEST(Weighing, FindsMassAndCentre) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const double mass = uniform(random, 0.6 * kMass, 3 * kMass);
    const PlanarPose centre{uniform(random, -0.1, 0.1), uniform(random, -0.1, 0.1), 0};
    const PerWheel load = standing_load(mass, centre);
    const Load weighed = weigh(load);
    EXPECT_NEAR(weighed.mass, mass, 1e-9);
    EXPECT_NEAR(weighed.centre.x, centre.x, 1e-12);
    EXPECT_NEAR(weighed.centre.y, centre.y, 1e-12);
    EXPECT_EQ(weighed.wheel, load);
  }
}

TEST(Weighing, FrontIsPositiveXAndLeftIsPositiveY) {
  const Load weighed = weigh({150, 110, 90, 70});
  EXPECT_NEAR(weighed.centre.x, 0.25 * (260.0 - 160.0) / 420, 1e-12);
  EXPECT_NEAR(weighed.centre.y, 0.30 * (240.0 - 180.0) / 420, 1e-12);
}

TEST(Weighing, WhatNoPlatformWeighsIsTakenForTheEmptyOne) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  expect_empty(weigh({}));
  expect_empty(weigh({100, 100, kNan, 100}));
  expect_empty(weigh({100, kInf, 100, 100}));
  expect_empty(weigh({200, 200, 200, -1}));
  expect_empty(weigh({40, 40, 40, 40}));
  expect_empty(weigh({500, 500, 500, 500}));
  expect_empty(weigh({400, 0, 0, 0}));
  expect_empty(weigh({1e308, 1e308, 1e308, 1e308}));
}

}  // namespace
}  // namespace mrroc::rex::test
