// Figures of a push that was made up.
#include "tasks/box_push/figures.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

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
  EXPECT_NE(scripts[0].second.find("set label '1' at "), std::string::npos) << "the number of the push";
  EXPECT_NE(scripts[1].second.find("box.csv"), std::string::npos);
}

TEST(PushTable, TurnsOfTheBoxDoNotJumpAndAreWithinHalfATurnAtTheEnd) {
  PushTable table;
  for (int n = 0; n < 100; ++n) {
    PushRow row{.stage = {n, kPush.m, 1}};
    row.box.p.phi = wrap_angle(0.1 * n - 2);
    table.push_back(row);
  }
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "mrroc_push_table.csv";
  write_push_table(file, table, {0, 0, 0.3}, 0.02);
  std::ifstream lines(file);
  std::string line;
  std::getline(lines, line);
  std::vector<double> turned;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string field;
    for (int k = 0; k <= column::error; ++k) std::getline(fields, field, ',');
    turned.push_back(std::stod(field));
  }
  std::filesystem::remove(file);
  ASSERT_EQ(turned.size(), table.size());
  for (std::size_t n = 1; n < turned.size(); ++n)
    EXPECT_NEAR(turned[n] - turned[n - 1], 0.1 * 180 / std::acos(-1.0), 0.01);
  EXPECT_LE(std::abs(turned.back()), 180);
}

}  // namespace
}  // namespace mrroc::box_push
