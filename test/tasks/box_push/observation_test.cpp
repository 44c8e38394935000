// Where something stands, by readings of which single ones are far off.
#include "tasks/box_push/observation.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::box_push::test {
namespace {

TEST(Observation, WithoutOutliersItIsTheMean) {
  const PlanarPose p = pose_of({{1, 2, 3.1}, {1.02, 1.96, -3.1}, {0.98, 2.01, 3.12}});
  EXPECT_NEAR(p.x, 1, 1e-12);
  EXPECT_NEAR(p.y, 1.99, 1e-12);
  EXPECT_NEAR(p.phi, (3.1 + 3.12 - 3.1 + 2 * std::numbers::pi) / 3, 1e-12) << "on the shorter way round";
}

TEST(Observation, OneReadingIsThatReading) {
  const PlanarPose p = pose_of({{-1, 0.5, -2}});
  EXPECT_EQ(p.x, -1);
  EXPECT_EQ(p.y, 0.5);
  EXPECT_EQ(p.phi, -2);
}

TEST(Observation, OutliersOfLessThanHalfOfTheReadingsMoveItByNothing) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  std::uniform_int_distribution<int> count(0, 4), sign(0, 1);
  for (int trial = 0; trial < 200; ++trial) {
    const PlanarPose truth{noise(random), noise(random), 3 * noise(random)};
    const int outliers = count(random);
    std::vector<PlanarPose> readings;
    for (int n = 0; n < 10; ++n) {
      const double off = n < outliers ? (sign(random) != 0 ? 0.5 : -0.5) : 0;
      readings.push_back({truth.x + off + 0.005 * noise(random), truth.y - off + 0.005 * noise(random),
                          truth.phi + 2 * off + 0.01 * noise(random)});
    }
    std::ranges::shuffle(readings, random);
    const PlanarPose p = pose_of(readings);
    EXPECT_NEAR(p.x, truth.x, 0.02);
    EXPECT_NEAR(p.y, truth.y, 0.02);
    EXPECT_NEAR(wrap_angle(p.phi - truth.phi), 0, 0.04);
  }
}

}  // namespace
}  // namespace mrroc::box_push::test
