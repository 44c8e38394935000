// Motion capture: when it measures, how well, when it tells, and what it loses.
#include "sim/platform/motion_capture.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/platform_path.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {
namespace {

constexpr PlanarPose kPose{.x = 1, .y = -2, .phi = 3};

/// @return all readings of so many steps of a platform that stands
std::vector<CapturedPose> readings(const MotionCaptureParameters& k, std::int64_t steps,
                                   std::uint64_t seed = 1) {
  MotionCaptureSystem system(k, seed, kPlatformStep);
  std::vector<CapturedPose> all;
  for (std::int64_t step = 0; step < steps; ++step) {
    const auto visible = system.step(step, kPose);
    if (!visible) continue;
    EXPECT_EQ(visible->reading.step + k.setup.latency, step);
    all.push_back(*visible);
  }
  return all;
}

TEST(MotionCapture, MeasuresEveryPeriodAndTellsItLater) {
  for (const MotionCaptureSetup setup :
       {MotionCaptureSetup{}, {.period = 7, .latency = 0}, {.period = 3, .latency = 40}}) {
    MotionCaptureParameters k;
    k.setup = setup;
    const auto all = readings(k, 1000);
    ASSERT_EQ(static_cast<std::int64_t>(all.size()), (999 - setup.latency) / setup.period + 1);
    for (std::size_t n = 0; n < all.size(); ++n) {
      EXPECT_EQ(all[n].number, static_cast<std::int64_t>(n));
      EXPECT_EQ(all[n].reading.step, all[n].number * setup.period);
      EXPECT_TRUE(all[n].reading.seen);
    }
  }
}

TEST(MotionCapture, NoiseIsAsWideAsItIsSaidToBe) {
  MotionCaptureParameters k;
  k.setup.period = 1;
  double x = 0, y = 0, phi = 0, product = 0;
  const auto all = readings(k, 20'000);
  const auto n = static_cast<double>(all.size());
  for (const CapturedPose& each : all) {
    const PlanarPose& p = each.reading.p;
    x += (p.x - kPose.x) * (p.x - kPose.x) / n;
    y += (p.y - kPose.y) * (p.y - kPose.y) / n;
    product += (p.x - kPose.x) * (p.y - kPose.y) / n;
    phi += wrap_angle(p.phi - kPose.phi) * wrap_angle(p.phi - kPose.phi) / n;
    ASSERT_LE(std::abs(p.phi), 3.15);
  }
  EXPECT_NEAR(std::sqrt(x), 0.005, 0.0002);
  EXPECT_NEAR(std::sqrt(y), 0.005, 0.0002);
  EXPECT_NEAR(product / 0.005 / 0.005, 0, 0.03);
  EXPECT_NEAR(std::sqrt(phi), 0.01, 0.0004);
}

TEST(MotionCapture, OutliersAreAsManyAsItIsSaid) {
  MotionCaptureParameters k;
  k.setup.period = 1;
  k.outliers = 0.1;
  int wrong = 0;
  const auto all = readings(k, 5000);
  for (const CapturedPose& each : all) {
    const double off = std::hypot(each.reading.p.x - kPose.x, each.reading.p.y - kPose.y);
    if (off < 0.05) continue;
    ++wrong;
    EXPECT_NEAR(off, 0.5, 0.05);
  }
  EXPECT_NEAR(wrong, 500, 90);
}

/// What is lost or displaced changes nothing of the others' noise.
TEST(MotionCapture, LosesThePlatformAndErrsAtTheTimesGiven) {
  MotionCaptureParameters k;
  const auto usual = readings(k, 5000);
  k.lost = {{.from = 1, .to = 2}, {.from = 4, .to = 4.5}};
  k.offset = {.x = 0.2, .y = 0, .phi = 0};
  k.displaced = {.from = 6, .to = 7};
  const auto all = readings(k, 5000);
  ASSERT_EQ(all.size(), usual.size());
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double time = 0.1 * static_cast<double>(n);
    const bool lost = (n >= 10 && n < 20) || (n >= 40 && n < 45);
    ASSERT_EQ(all[n].reading.seen, !lost) << time;
    if (lost) continue;
    EXPECT_NEAR(all[n].reading.p.x - usual[n].reading.p.x, n >= 60 && n < 70 ? 0.2 : 0, 1e-12) << time;
    EXPECT_EQ(all[n].reading.p.phi, usual[n].reading.p.phi);
  }
}

}  // namespace
}  // namespace mrroc::sim
