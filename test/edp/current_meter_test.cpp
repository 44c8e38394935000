// Statistics of motor currents that are known.
#include "edp/current_meter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace mrroc::edp::test {
namespace {

using Currents = std::array<double, kMaxAxes>;

TEST(CurrentMeter, GivesMeanRootMeanSquareAndExtremesOfKnownCurrents) {
  CurrentMeter meter;
  for (const double i : {1., -3., 2.}) meter.add({i, 2 * i});
  const CurrentStatistics s = meter.take();
  EXPECT_DOUBLE_EQ(s.mean[0], 0);
  EXPECT_DOUBLE_EQ(s.mean[1], 0);
  EXPECT_DOUBLE_EQ(s.rms[0], std::sqrt(14. / 3));
  EXPECT_DOUBLE_EQ(s.rms[1], 2 * std::sqrt(14. / 3));
  EXPECT_EQ(s.least[0], -3);
  EXPECT_EQ(s.least[1], -6);
  EXPECT_EQ(s.greatest[0], 2);
  EXPECT_EQ(s.greatest[1], 4);
  EXPECT_EQ(s.rms[2], 0) << "of a motor without current";
}

TEST(CurrentMeter, OfOneStepAllButTheSpreadIsItsCurrent) {
  for (const double i : {-2.5, 0., 0.25}) {
    CurrentMeter meter;
    meter.add({i});
    const CurrentStatistics s = meter.take();
    EXPECT_EQ(s.mean[0], i);
    EXPECT_EQ(s.least[0], i);
    EXPECT_EQ(s.greatest[0], i);
    EXPECT_DOUBLE_EQ(s.rms[0], std::abs(i));
  }
}

TEST(CurrentMeter, EveryMotorIsMeasuredByItselfOverTheStepsSinceTheReplyBefore) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> current(-8, 8);
  CurrentMeter meter;
  for (const int steps : {1, 10, 25}) {
    std::vector<Currents> all(static_cast<std::size_t>(steps));
    for (Currents& step : all) {
      for (double& i : step) i = current(random);
      meter.add(step);
    }
    const CurrentStatistics s = meter.take();
    for (std::size_t k = 0; k < static_cast<std::size_t>(kMaxAxes); ++k) {
      double sum = 0, squares = 0, least = all[0][k], greatest = all[0][k];
      for (const Currents& step : all) {
        sum += step[k];
        squares += step[k] * step[k];
        least = std::min(least, step[k]);
        greatest = std::max(greatest, step[k]);
      }
      EXPECT_NEAR(s.mean[k], sum / steps, 1e-12);
      EXPECT_NEAR(s.rms[k], std::sqrt(squares / steps), 1e-12);
      EXPECT_EQ(s.least[k], least);
      EXPECT_EQ(s.greatest[k], greatest);
    }
  }
}

TEST(CurrentMeter, WithoutAStepItGivesZeros) {
  CurrentMeter meter;
  meter.add({5});
  (void)meter.take();
  const CurrentStatistics s = meter.take();
  EXPECT_EQ(s.mean[0], 0);
  EXPECT_EQ(s.rms[0], 0);
  EXPECT_EQ(s.least[0], 0);
  EXPECT_EQ(s.greatest[0], 0);
}

}  // namespace
}  // namespace mrroc::edp::test
