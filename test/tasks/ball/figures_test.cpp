#include "tasks/ball/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tasks/ball/path.hpp"

namespace mrroc::ball {
namespace {

/// A run around the circle in which the object is so far off along the line, and pressed so.
std::vector<BodyRow> rows_with(double off, double press) {
  const Parameters k;
  std::vector<BodyRow> rows;
  for (int n = 0; n <= k.turn; ++n) {
    BodyRow row;
    row.i = n;
    row.m = kCircle;
    row.wanted = path(k, kCircle, n);
    row.T_UO.p = Vector3(1, 2, 3) + row.wanted + (n > 0 ? off : 0) * kLine;
    row.press = {press, press + 1};
    rows.push_back(row);
  }
  return rows;
}

double value(const mp::TaskFigures& figures, std::string_view key) {
  return std::get<double>(mp::figure(figures, key));
}

TEST(BallFigures, CountTheWeakerPalmAndTheObjectFromWhereItWasLifted) {
  const auto figures = ball::figures(rows_with(0.003, 12), {}, false);
  EXPECT_NEAR(value(figures, "inner_force_N"), 12, 1e-9);
  EXPECT_NEAR(value(figures, "inner_force_peak_N"), 13, 1e-9);
  EXPECT_NEAR(value(figures, "circle_rms_mm"), 3, 0.01);
  EXPECT_EQ(value(figures, "falls"), 0);
}

TEST(BallFigures, KnowAFallAndAnObjectThatWasNotCarried) {
  auto rows = rows_with(0, 12.5);
  rows[400].on_pedestal = true;
  EXPECT_EQ(value(ball::figures(rows, {}, false), "falls"), 1);
  EXPECT_TRUE(std::isnan(value(ball::figures({}, {}, false), "inner_force_N")));
}

TEST(BallFigures, TellOfAPushedPairHowFarItYielded) {
  auto rows = rows_with(0, 12.5);
  for (BodyRow& row : rows)
    if (row.i > 300 && row.i < 500) row.T_UO.p += (row.yielded = Vector3(0.02, 0, 0));
  const auto figures = ball::figures(rows, {}, true);
  EXPECT_NEAR(value(figures, "yielded_mm"), 20, 1e-6);
  EXPECT_THROW(std::ignore = mp::figure(figures, "circle_rms_mm"), std::out_of_range);
}

}  // namespace
}  // namespace mrroc::ball
