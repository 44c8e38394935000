// Fragments between their knots, and angles within one turn.
#include "base/platform_path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "base/platform_command.hpp"

namespace mrroc::test {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kExact = 1e-12;

PathPoint on_circle(double v, double w, double time) {
  const double phi = 0.4 + w * time;
  return {
      {1 + v / w * (std::sin(phi) - std::sin(0.4)), -2 - v / w * (std::cos(phi) - std::cos(0.4)), phi}, v, w};
}

Fragment circle(double v, double w, std::int32_t steps) {
  Fragment fragment;
  fragment.number = 1;
  fragment.steps = steps;
  for (std::size_t k = 0; k < kFragmentKnots; ++k)
    fragment.knot[k] =
        on_circle(v, w, steps * kPlatformPeriod * static_cast<double>(k) / (kFragmentKnots - 1));
  return fragment;
}

TEST(Fragment, PassesThroughItsKnots) {
  const Fragment fragment = circle(0.5, 0.8, 200);
  for (std::size_t k = 0; k < kFragmentKnots; ++k) {
    const PathPoint point = point_at(fragment, static_cast<double>(k) / (kFragmentKnots - 1));
    EXPECT_NEAR(point.p.x, fragment.knot[k].p.x, kExact);
    EXPECT_NEAR(point.p.y, fragment.knot[k].p.y, kExact);
    EXPECT_NEAR(point.p.phi, fragment.knot[k].p.phi, kExact);
    EXPECT_NEAR(point.v, fragment.knot[k].v, kExact);
    EXPECT_NEAR(point.w, fragment.knot[k].w, kExact);
  }
}

TEST(Fragment, FollowsACircleBetweenItsKnots) {
  for (const double v : {-0.7, 0.2, 1.0})
    for (const double w : {-1.5, 0.3, 2.5}) {
      const Fragment fragment = circle(v, w, 200);  // 125 ms between knots
      for (double s = 0; s <= 1; s += 0.003) {
        const PathPoint point = point_at(fragment, s);
        const PathPoint exact = on_circle(v, w, s * 200 * kPlatformPeriod);
        EXPECT_NEAR(point.p.x, exact.p.x, 1e-4);
        EXPECT_NEAR(point.p.y, exact.p.y, 1e-4);
        EXPECT_NEAR(point.p.phi, exact.p.phi, kExact);
      }
    }
}

TEST(Fragment, ItsSlopesAreTheKnotsSpeeds) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<> uniform(-1, 1);
  Fragment fragment;
  fragment.steps = 160;
  for (PathPoint& knot : fragment.knot)
    knot = {{uniform(random), uniform(random), 3 * uniform(random)}, uniform(random), uniform(random)};
  const double ds = 1e-7;
  const double dt = ds * fragment.steps * kPlatformPeriod;
  for (std::size_t k = 1; k + 1 < kFragmentKnots; ++k) {
    const double s = static_cast<double>(k) / (kFragmentKnots - 1);
    const PathPoint& knot = fragment.knot[k];
    for (const double side : {-ds, ds}) {
      const PathPoint near = point_at(fragment, s + side);
      const double time = side > 0 ? dt : -dt;
      EXPECT_NEAR((near.p.x - knot.p.x) / time, knot.v * std::cos(knot.p.phi), 1e-3);
      EXPECT_NEAR((near.p.y - knot.p.y) / time, knot.v * std::sin(knot.p.phi), 1e-3);
      EXPECT_NEAR((near.p.phi - knot.p.phi) / time, knot.w, 1e-3);
    }
  }
}

TEST(Fragment, TurnsThroughMoreThanHalfATurnWithoutAJump) {
  const Fragment fragment = circle(0.1, 2, 320);  // two turns
  double before = point_at(fragment, 0).p.phi;
  for (double s = 0.001; s <= 1; s += 0.001) {
    const double phi = point_at(fragment, s).p.phi;
    EXPECT_GT(phi, before);
    EXPECT_LT(phi - before, 0.02);
    before = phi;
  }
  EXPECT_NEAR(before - fragment.knot[0].p.phi, 12.8, 0.05);
}

TEST(Fragment, TheLongestOneLastsSixSecondsWithAKnotInEveryFifth) {
  constexpr double kLongest = kMaxFragmentSteps * kPlatformPeriod;
  EXPECT_DOUBLE_EQ(kLongest, 6.4);
  EXPECT_DOUBLE_EQ(kLongest / static_cast<double>(kFragmentKnots - 1), 0.2);
  const Fragment fragment = circle(1, 1, kMaxFragmentSteps);
  for (double s = 0; s <= 1; s += 0.003) {
    const PathPoint point = point_at(fragment, s), exact = on_circle(1, 1, s * kLongest);
    EXPECT_NEAR(point.p.x, exact.p.x, 1e-4);
    EXPECT_NEAR(point.p.y, exact.p.y, 1e-4);
    EXPECT_NEAR(point.p.phi, exact.p.phi, kExact);
  }
}

TEST(Fragment, OutsideOfItStandsTheNearerEnd) {
  const Fragment fragment = circle(0.5, 0.8, 100);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double s : {-inf, -1., 0., std::nan("")})
    EXPECT_EQ(point_at(fragment, s).p.x, fragment.knot[0].p.x);
  for (const double s : {1., 1.5, inf})
    EXPECT_NEAR(point_at(fragment, s).p.x, fragment.knot[kFragmentKnots - 1].p.x, kExact);
}

TEST(Slip, OfAGroundThatNobodyHasDescribedIsTheNominalOne) {
  constexpr Slip kNominal;
  EXPECT_EQ(kNominal.mu_x, 0.7);
  EXPECT_EQ(kNominal.mu_y, 0.6);
  EXPECT_EQ(kNominal.split, 0);
}

TEST(WrapAngle, KeepsTheDirectionWithinOneTurn) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<> uniform(-100, 100);
  for (int k = 0; k < 10'000; ++k) {
    const double angle = uniform(random);
    const double wrapped = wrap_angle(angle);
    EXPECT_GT(wrapped, -kPi);
    EXPECT_LE(wrapped, kPi);
    EXPECT_NEAR(std::sin(wrapped), std::sin(angle), kExact);
    EXPECT_NEAR(std::cos(wrapped), std::cos(angle), kExact);
  }
}

TEST(WrapAngle, HalfATurnIsPositive) {
  EXPECT_EQ(wrap_angle(kPi), kPi);
  EXPECT_EQ(wrap_angle(-kPi), kPi);
  EXPECT_EQ(wrap_angle(0), 0);
}

TEST(WrapAngle, WhatIsNotFiniteHasNoDirection) {
  const double inf = std::numeric_limits<double>::infinity();
  for (const double angle : {inf, -inf, std::nan("")}) EXPECT_TRUE(std::isnan(wrap_angle(angle)));
}

}  // namespace
}  // namespace mrroc::test
