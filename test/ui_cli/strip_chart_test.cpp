#include "ui_cli/strip_chart.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace mrroc::test {
namespace {

using ui::Glyphs;
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

TEST(StripChart, RisesWithTheSample) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> force(-5, 20);
  constexpr std::u32string_view kLevels = U" ▁▂▃▄▅▆▇█";
  for (int round = 0; round < 200; ++round) {
    const std::vector<double> samples{force(random), force(random)};
    const auto chart = strip_chart(samples, 2, 3, Glyphs::unicode, 2);
    std::size_t level[2]{};
    for (const auto& row : chart.rows)
      for (std::size_t k = 0; k < 2; ++k) level[k] += kLevels.find(row[k]);
    EXPECT_GE(level[samples[1] > samples[0]], level[samples[1] <= samples[0]]);
    EXPECT_GE(std::min(level[0], level[1]), 1U);
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

}  // namespace
}  // namespace mrroc::test
