// How the reference of a platform goes along with a map that moves, and comes back.
#include "edp/platform/reference_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace mrroc::edp::test {
namespace {

constexpr double kPeriod = 0.05;  // between points [s]

class Offset : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random{GetParam()};
  double number(double most) { return std::uniform_real_distribution(-most, most)(random); }
  PlanarPose pose(double most, double turned) { return {number(most), number(most), number(turned)}; }
  /// @return points anywhere
  Reference reference() {
    Reference r{};
    for (PathPoint& point : r) point = {pose(3, 7), number(1), number(2)};
    return r;
  }
};

INSTANTIATE_TEST_SUITE_P(Random, Offset, testing::Range(1U, 21U));

TEST_P(Offset, LeavesTheReferenceAsItIsUntilTheEstimateIsDisplaced) {
  const Reference wanted = reference();
  ReferenceOffset offset;
  offset.come_back(wanted[3].p);
  const Reference r = offset.applied(wanted, kPeriod);
  for (std::size_t k = 0; k < r.size(); ++k) {
    EXPECT_EQ(r[k].p.x, wanted[k].p.x);
    EXPECT_EQ(r[k].p.y, wanted[k].p.y);
    EXPECT_EQ(r[k].p.phi, wanted[k].p.phi);
  }
}

TEST_P(Offset, KeepsWhereTheReferenceIsFromThePlatform) {
  const Reference wanted = reference();
  PlanarPose platform = pose(3, 3);
  const PlanarPose before = seen_from(platform, wanted[0].p);
  ReferenceOffset offset;
  for (int k = 0; k < 3; ++k) {
    const PlanarPose displacement = pose(0.5, 1);
    offset.add(displacement);
    platform = chained(displacement, platform);
    const PlanarPose after = seen_from(platform, offset.applied(wanted, kPeriod)[0].p);
    EXPECT_NEAR(after.x, before.x, 1e-9);
    EXPECT_NEAR(after.y, before.y, 1e-9);
    EXPECT_NEAR(wrap_angle(after.phi - before.phi), 0, 1e-9);
  }
}

TEST_P(Offset, ComesBackAtItsSpeedAndArrives) {
  Reference wanted{};
  wanted.fill({.p = pose(3, 3)});
  const PlanarPose& p = wanted[0].p;
  ReferenceOffset offset;
  offset.add(pose(0.4, 0.2));
  const auto apart = [&] { return distance(offset.applied(wanted, kPeriod)[0].p, p); };
  const auto turned = [&] { return std::abs(offset.applied(wanted, kPeriod)[0].p.phi - p.phi); };
  const double away = apart(), angle = turned();
  for (int k = 1; away - k * kPlatformPeriod * ReferenceOffset::kBack > 1e-6; ++k) {
    offset.come_back(p);
    EXPECT_NEAR(apart(), away - k * kPlatformPeriod * ReferenceOffset::kBack, 1e-9);
    EXPECT_NEAR(turned(), std::max(0.0, angle - k * kPlatformPeriod * ReferenceOffset::kTurnedBack), 1e-9);
  }
  for (int k = 0; k < 1000; ++k) offset.come_back(p);
  EXPECT_NEAR(apart(), 0, 1e-12);
  EXPECT_EQ(turned(), 0);
}

TEST_P(Offset, TellsAheadHowItWillComeBack) {
  Reference wanted{};
  wanted.fill({.p = pose(3, 3)});
  ReferenceOffset offset;
  offset.add(pose(0.4, 0.2));
  const Reference ahead = offset.applied(wanted, kPlatformPeriod);
  for (std::size_t k = 0; k < ahead.size(); ++k) {
    const PlanarPose now = offset.applied(wanted, kPlatformPeriod)[0].p;
    EXPECT_NEAR(distance(ahead[k].p, now), 0, 1e-9) << k;
    EXPECT_NEAR(ahead[k].p.phi, now.phi, 1e-9) << k;
    offset.come_back(wanted[0].p);
  }
}

}  // namespace
}  // namespace mrroc::edp::test
