// The shape of round plates against Bullet's hull of the same corners.
#include "sim/bullet/round_prism.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace mrroc::sim {
namespace {

constexpr int kCorners = 360;

/// Prism and hull of a plate.
struct Shapes {
  Shapes(double length, double width, double thickness) : prism(length, width, thickness, kCorners) {
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2 * std::numbers::pi * k / kCorners;
      for (const double z : {-thickness / 2, thickness / 2})
        hull.addPoint({length / 2 * std::cos(angle), width / 2 * std::sin(angle), z}, false);
    }
    hull.setMargin(0);
    hull.recalcLocalAabb();
  }
  [[nodiscard]] bool same(const btVector3& direction) const {
    return prism.localGetSupportVertexWithoutMarginNonVirtual(direction) ==
           hull.localGetSupportVertexWithoutMarginNonVirtual(direction);
  }

  RoundPrism prism;
  btConvexHullShape hull;
};

TEST(RoundPrism, ItsFarthestCornerIsThatOfBulletsHullInAllDirections) {
  std::mt19937_64 random(7);
  std::normal_distribution<> normal;
  std::uniform_real_distribution<> exponent(-14, 0);
  for (const auto& [length, width] : {std::pair(0.2, 0.2), std::pair(0.24, 0.16), std::pair(0.1, 0.3)}) {
    const Shapes shapes(length, width, 0.02);
    for (int k = 0; k < 20'000; ++k) {
      // Half of them nearly upright or nearly flat.
      const double flat = k % 4 == 0 ? std::pow(10, exponent(random)) : 1;
      const double upright = k % 4 == 1 ? std::pow(10, exponent(random)) : 1;
      const btVector3 d(flat * normal(random), flat * normal(random), upright * normal(random));
      ASSERT_TRUE(shapes.same(d)) << d.x() << " " << d.y() << " " << d.z();
    }
  }
}

TEST(RoundPrism, WhereCornersAreEquallyFarTheFirstOneCounts) {
  const Shapes shapes(0.24, 0.16, 0.02);
  for (const double x : {-1., 0., 1.})
    for (const double y : {-1., 0., 1.})
      for (const double z : {-1., 0., 1.}) EXPECT_TRUE(shapes.same({x, y, z})) << x << " " << y << " " << z;
  for (int k = 0; k < 2 * kCorners; ++k) {  // corners, and the middles of sides
    const double angle = std::numbers::pi * k / kCorners;
    EXPECT_TRUE(shapes.same({std::cos(angle) / 0.24, std::sin(angle) / 0.16, 0})) << k;
  }
}

TEST(RoundPrism, ItsBoundsAreThoseOfTheHull) {
  const Shapes shapes(0.24, 0.16, 0.02);
  const btTransform T(btQuaternion(btVector3(1, 2, 3).normalized(), 0.7), {0.1, -0.2, 0.3});
  btVector3 low, high, hull_low, hull_high;
  shapes.prism.getAabb(T, low, high);
  shapes.hull.getAabb(T, hull_low, hull_high);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(low[axis], hull_low[axis], 1e-12);
    EXPECT_NEAR(high[axis], hull_high[axis], 1e-12);
  }
}

}  // namespace
}  // namespace mrroc::sim
