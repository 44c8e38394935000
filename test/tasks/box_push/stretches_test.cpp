// Fragments of straight ways, of turns, and of stretches that a pair drives.
#include "tasks/box_push/stretches.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/planar.hpp"

namespace mrroc::box_push {
namespace {

const DriveLimits kLimits;

/// Every fragment begins where the one before ends, its numbers are within what an effector driver takes.
void expect_joined(const std::vector<Fragment>& all, const PlanarPose& from) {
  PathPoint before{from};
  for (const Fragment& f : all) {
    EXPECT_GE(f.steps, 1);
    EXPECT_LE(f.steps, kMaxFragmentSteps);
    EXPECT_LT(f.notify, f.steps);
    EXPECT_GE(f.notify, -kMaxFragmentSteps);
    const PathPoint& begin = f.knot.front();
    EXPECT_NEAR(distance(begin.p, before.p), 0, 1e-9);
    EXPECT_NEAR(begin.p.phi, before.p.phi, 1e-9);
    EXPECT_NEAR(begin.v, before.v, 1e-9);
    EXPECT_NEAR(begin.w, before.w, 1e-9);
    before = f.knot.back();
  }
}

/// Knots and their speeds tell the same.
void expect_consistent(const Fragment& f) {
  const double h = 1e-4;
  for (const double s : {0.1, 0.37, 0.5, 0.81}) {
    const PathPoint before = point_at(f, s - h), now = point_at(f, s), after = point_at(f, s + h);
    const double time = 2 * h * f.steps * kPlatformPeriod;
    const double along =
        ((after.p.x - before.p.x) * std::cos(now.p.phi) + (after.p.y - before.p.y) * std::sin(now.p.phi)) /
        time;
    const double across =
        ((after.p.y - before.p.y) * std::cos(now.p.phi) - (after.p.x - before.p.x) * std::sin(now.p.phi)) /
        time;
    EXPECT_NEAR(along, now.v, 0.01) << s;
    EXPECT_NEAR(across, 0, 0.002) << s << ": it does not slip aside";
    EXPECT_NEAR((after.p.phi - before.p.phi) / time, now.w, 0.01) << s;
  }
}

TEST(Straight, LeadsFromRestToRestWithinTheSpeed) {
  const PlanarPose from{1, 2, 0.5};
  for (const double length : {0.05, 1.0, 7.0, -0.4}) {
    const auto all = straight(from, length, kLimits);
    ASSERT_FALSE(all.empty());
    expect_joined(all, from);
    const PathPoint end = all.back().knot.back();
    EXPECT_EQ(end.v, 0);
    EXPECT_NEAR(seen_from(from, end.p).x, length, 1e-9);
    EXPECT_NEAR(seen_from(from, end.p).y, 0, 1e-9);
    for (const Fragment& f : all) {
      expect_consistent(f);
      for (const PathPoint& knot : f.knot) EXPECT_LE(std::abs(knot.v), kLimits.speed * 1.001);
    }
  }
  EXPECT_TRUE(straight(from, 0, kLimits).empty());
}

TEST(Turn, LeadsFromRestToRestOnTheSpot) {
  const PlanarPose from{1, 2, 0.5};
  for (const double angle : {0.01, 1.0, -3.1}) {
    const auto all = turn(from, angle, kLimits);
    ASSERT_FALSE(all.empty());
    expect_joined(all, from);
    const PathPoint end = all.back().knot.back();
    EXPECT_NEAR(end.p.phi, from.phi + angle, 1e-9);
    EXPECT_NEAR(distance(end.p, from), 0, 1e-12);
    for (const Fragment& f : all) {
      expect_consistent(f);
      for (const PathPoint& knot : f.knot) EXPECT_LE(std::abs(knot.w), kLimits.turn_rate * 1.001);
    }
  }
}

TEST(Stretch, BothPlatformsKeepTheirPlacesInThePair) {
  const Stretch s{{0.3, -0.2, 1}, 0.05, 0.12, 0.1, -0.4, 25};
  const Fragment left = fragment_of(s, 0.5, kLimits), right = fragment_of(s, -0.5, kLimits);
  for (std::size_t knot = 0; knot < kFragmentKnots; ++knot) {
    const PlanarPose between = seen_from(left.knot[knot].p, right.knot[knot].p);
    EXPECT_NEAR(between.x, 0, 1e-12);
    EXPECT_NEAR(between.y, -1, 1e-12);
    EXPECT_NEAR(between.phi, 0, 1e-12);
  }
  expect_consistent(left);
  expect_consistent(right);
  EXPECT_GT(right.knot.front().v, left.knot.front().v) << "to the left the right one has the longer way";
}

TEST(Stretch, OnAnArcEndsWhereTheArcDoes) {
  const double curvature = 0.5, speed = 0.2;
  const Stretch s{{}, speed, speed, curvature, curvature, 100};
  const double angle = speed * 2 * curvature;
  const PathPoint end = point_of(s, 1);
  EXPECT_NEAR(end.p.phi, angle, 1e-9);
  EXPECT_NEAR(end.p.x, std::sin(angle) / curvature, 1e-5);
  EXPECT_NEAR(end.p.y, (1 - std::cos(angle)) / curvature, 1e-5);
}

}  // namespace
}  // namespace mrroc::box_push
