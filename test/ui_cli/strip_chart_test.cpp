#include "ui_cli/strip_chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "ui_cli/history.hpp"

namespace mrroc::test {
namespace {

using ui::Glyphs;
using ui::History;
using ui::Quantity;
using ui::Snapshot;
using ui::strip_chart;

TEST(StripChart, ShowsTheNewestSamplesAtTheRight) {
  const std::vector<double> samples{9, 9, 0, 1, 2};
  const auto chart = strip_chart(samples, 3, 1, Glyphs::unicode, 2);
  ASSERT_EQ(chart.rows.size(), 1U);
  EXPECT_EQ(chart.rows[0], U"▁▅█");
  EXPECT_EQ(strip_chart(samples, 7, 1, Glyphs::unicode, 2).rows[0].substr(0, 2), U"  ");
}

TEST(StripChart, KeepsItsScaleUntilASampleLeavesIt) {
  const std::vector<double> small{0.3, 1.9, 2};
  EXPECT_EQ(strip_chart(small, 5, 1, Glyphs::ascii, 2).high, 2);
  EXPECT_EQ(strip_chart(small, 5, 1, Glyphs::ascii, 2).low, 0);
  const std::vector<double> large{0.3, 2.1};
  EXPECT_EQ(strip_chart(large, 5, 1, Glyphs::ascii, 2).high, 5);
  const std::vector<double> noise{-0.15, 1};
  EXPECT_EQ(strip_chart(noise, 5, 1, Glyphs::ascii, 2).low, 0);
  const std::vector<double> pull{-0.7, 1};
  EXPECT_EQ(strip_chart(pull, 5, 1, Glyphs::ascii, 2).low, -1);
}

TEST(StripChart, UsesEveryRowOfATallOne) {
  const std::vector<double> samples{0, 4};
  const auto filled = strip_chart(samples, 2, 2, Glyphs::unicode, 4);
  EXPECT_EQ(filled.rows[0], U" █");
  EXPECT_EQ(filled.rows[1], U"▁█");
  const auto drawn = strip_chart(samples, 2, 2, Glyphs::ascii, 4);
  EXPECT_EQ(drawn.rows[0], U" #");
  EXPECT_EQ(drawn.rows[1], U"_ ");
}

TEST(StripChart, LeavesAGapForWhatIsNotANumber) {
  const std::vector<double> samples{1, std::nan(""), std::numeric_limits<double>::infinity(), 1};
  EXPECT_EQ(strip_chart(samples, 4, 1, Glyphs::ascii, 1).rows[0], U"#  #");
}

TEST(StripChart, BarsBeginAtZeroAlsoWhereSamplesAreNegative) {
  const std::vector<double> samples{0, 10, -10, -20};
  const auto chart = strip_chart(samples, 4, 4, Glyphs::unicode, 2);
  EXPECT_EQ(chart.high, 20);
  EXPECT_EQ(chart.low, -20);
  EXPECT_EQ(chart.rows[0], U"    ");
  EXPECT_EQ(chart.rows[1], U"▁█  ") << "above zero";
  EXPECT_EQ(chart.rows[2], U"  ██") << "below zero";
  EXPECT_EQ(chart.rows[3], U"   █");
}

TEST(StripChart, ASingleRowHangsNegativeBarsFromItsUpperEdge) {
  const std::vector<double> samples{2, -2, -1, -0.3};
  EXPECT_EQ(strip_chart(samples, 4, 1, Glyphs::unicode, 2).rows[0], U"██▀▔");
}

TEST(StripChart, RisesWithTheSample) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> force(-5, 20);
  constexpr std::u32string_view kUp = U" ▁▂▃▄▅▆▇█", kDown = U" ▔▀█";
  for (int round = 0; round < 200; ++round) {
    const std::vector<double> samples{force(random), force(random)};
    const auto chart = strip_chart(samples, 2, 4, Glyphs::unicode, 2);
    if (chart.low == 0) continue;  // no bar below zero
    const double row = (chart.high - chart.low) / 4;
    const auto zero = static_cast<std::size_t>(std::lround(chart.high / row));
    ASSERT_NEAR(static_cast<double>(zero) * row, chart.high, 1e-9) << "zero is between two rows";
    double level[2]{};
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t r = 0; r < 4; ++r) {
        const bool up = r < zero;
        const std::size_t found = (up ? kUp : kDown).find(chart.rows[r][k]);
        ASSERT_NE(found, std::u32string_view::npos);
        level[k] += up ? static_cast<double>(found) / 8 : -static_cast<double>(found) / 3;
      }
    EXPECT_GE(level[samples[1] > samples[0]], level[samples[1] <= samples[0]]);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NE(level[k], 0) << "every sample has a mark";
      EXPECT_EQ(level[k] > 0, samples[k] >= 0);
    }
  }
}

TEST(StripChart, CanHaveAnySize) {
  const std::vector<double> samples{1e300, -1e300, 1e-320, -1e-320};
  for (const int width : {-1, 0, 1, 500})
    for (const int height : {-1, 0, 1, 7}) {
      const auto chart = strip_chart(samples, width, height, Glyphs::unicode, 2);
      EXPECT_EQ(chart.rows.size(), static_cast<std::size_t>(std::max(height, 0)));
      for (const auto& row : chart.rows) EXPECT_EQ(row.size(), static_cast<std::size_t>(std::max(width, 0)));
    }
}

TEST(History, AForceBeforeTheFirstBehaviourDoesNotSetTheScale) {
  History history;
  const auto add = [&](int m, double F_z) {
    Snapshot s;
    ui::AgentView& arm = s.agents.emplace_back();
    arm.name = "arm1";
    arm.m = m;
    arm.F_a[2] = F_z;
    history.add(s);
  };
  add(0, -13);
  add(0, -13);
  EXPECT_EQ(history.samples("arm1", Quantity::F_z, 10), (std::vector<double>{-13, -13}))
      << "there is no other";
  add(1, 4);
  add(0, 3);  // after the last behaviour
  const auto F_z = history.samples("arm1", Quantity::F_z, 10);
  ASSERT_EQ(F_z.size(), 4U);
  EXPECT_TRUE(std::isnan(F_z[0]) && std::isnan(F_z[1]));
  EXPECT_EQ(F_z[2], 4);
  EXPECT_EQ(F_z[3], 3);
  EXPECT_EQ(strip_chart(F_z, 4, 2, Glyphs::unicode, 2).low, 0);
}

}  // namespace
}  // namespace mrroc::test
