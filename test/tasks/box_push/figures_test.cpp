// Figures of a push that was made up.
#include "tasks/box_push/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

#include "tasks/box_push/plots.hpp"

namespace mrroc::box_push {
namespace {

/// A box that goes 1 m along x in 100 rows.
PushResults made_up() {
  PushResults r;
  r.k.goal = {1.003, 0.004, -0.02};
  for (int n = 0; n <= 120; ++n) {
    PushRow row{.stage = {n, n < 10 ? kStart.m : kPush.m, n < 10 ? 0 : 1}};
    const bool moves = n >= 20 && n < 120;
    row.box.p = {0.01 * std::max(0, n - 20), 0, 0};
    row.box.speed = {moves ? 0.5 : 0, 0, 0};
    row.box.push = {moves ? 300.0 : 150.0, 0, 0};
    r.table.push_back(row);
  }
  return r;
}

TEST(PushFigures, AreThoseOfTheTruth) {
  const mp::Figures f = figures_of(made_up());
  EXPECT_NEAR(std::get<double>(f.at("box_err_mm")), 5, 1e-9);
  EXPECT_NEAR(std::get<double>(f.at("box_err_deg")), 0.02 * 180 / std::acos(-1.0), 1e-9);
  EXPECT_EQ(std::get<double>(f.at("pushes")), 1);
  EXPECT_NEAR(std::get<double>(f.at("push_mean_N")), 300, 1e-9) << "while it moves";
  EXPECT_NEAR(std::get<double>(f.at("way_m")), 1, 1e-9);
  EXPECT_NEAR(std::get<double>(f.at("run_s")), 111 * 0.02, 1e-9);
  EXPECT_TRUE(figures_of({}).empty());
}

TEST(PushFigures, EveryOneIsExplained) {
  for (const auto& [key, value] : figures_of(made_up()))
    EXPECT_NE(mp::info_of(key, kFigures), nullptr) << key;
}

TEST(PushPlots, ShowGoalAndBox) {
  const auto scripts = plots(made_up());
  ASSERT_EQ(scripts.size(), 2U);
  EXPECT_NE(scripts[0].second.find("$goal"), std::string::npos);
  EXPECT_NE(scripts[1].second.find("box.csv"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::box_push
