#include "sim/hand_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace mrroc::sim {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr HandPath::Limits kLimits{.speed = 0.02, .acceleration = 0.1};

Points circle(double radius) {
  Points p;
  for (int k = 0; k <= 360; ++k) {
    const double a = k * std::numbers::pi / 180;
    p.emplace_back(radius * std::cos(a), radius * std::sin(a));
  }
  return p;
}

TEST(HandPath, CutsAtCornersOnly) {
  const Points square{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
  const auto pieces = cut_at_corners(square, 0.4);
  ASSERT_EQ(pieces.size(), 4U);
  for (std::size_t k = 1; k < pieces.size(); ++k) EXPECT_EQ(pieces[k].front(), pieces[k - 1].back());
  EXPECT_EQ(cut_at_corners(circle(1), 0.4).size(), 1U);
}

TEST(HandPath, RepeatedPointsAreNoCorner) {
  EXPECT_EQ(cut_at_corners({{0, 0}, {1, 0}, {1, 0}, {2, 0}}, 0.4).size(), 1U);
  EXPECT_EQ(cut_at_corners({{1, 2}}, 0.4), (std::vector<Points>{{{1, 2}}}));
}

TEST(HandPath, LeadsFromTheFirstPointToTheLast) {
  const Points line{{0, 0}, {0.03, 0}, {0.03, 0.0401}};
  const HandPath path(line, kLimits);
  EXPECT_NEAR(path.length(), 0.0701, 1e-12);
  EXPECT_LT((path.at(0) - line.front()).norm(), 1e-12);
  EXPECT_LT((path.at(path.length()) - line.back()).norm(), 1e-12);
  EXPECT_LT((path.at(0.02) - Eigen::Vector2d(0.02, 0)).norm(), 1e-12);
}

TEST(HandPath, KeepsToItsSpeedAndAccelerationEverywhere) {
  const HandPath path(circle(0.001), kLimits);
  constexpr double kStep = 1e-5;
  for (double s = 1e-3; s < path.length() - 1e-3; s += kStep) {
    const double v = path.speed_at(s), next = path.speed_at(s + kStep);
    EXPECT_LE(v, kLimits.speed + 1e-12);
    EXPECT_LE(std::abs(next * next - v * v) / (2 * kStep), 1.01 * kLimits.acceleration);
  }
  const double bend = path.speed_at(path.length() / 2);
  EXPECT_NEAR(bend * bend / 0.001, kLimits.acceleration, 0.2 * kLimits.acceleration);
}

TEST(HandPath, IsWalkedToItsEndInFiniteTime) {
  for (const Points& points : {Points{{0, 0}, {1e-5, 0}}, Points{{0, 0}, {0.3, 0.1}}, circle(0.02)}) {
    const HandPath path(points, kLimits);
    double s = 0, t = 0;
    while (s < path.length() && t < 100) {
      s += 1e-3 * path.speed_at(s);
      t += 1e-3;
    }
    EXPECT_LT(t, path.length() / kLimits.speed + 1);
  }
}

TEST(HandPath, OnePointHasNoLength) {
  const HandPath path({{0.1, 0.2}}, kLimits);
  EXPECT_EQ(path.length(), 0);
  EXPECT_EQ(path.at(1), Eigen::Vector2d(0.1, 0.2));
}

}  // namespace
}  // namespace mrroc::sim
