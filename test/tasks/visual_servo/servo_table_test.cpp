#include "tasks/visual_servo/servo_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

namespace mrroc::visual_servo {
namespace {

/// E comes along x to an object at rest at 0; ten control steps are a second.
ServoTable approach(const std::vector<double>& x_mm) {
  ServoTable table;
  for (const double x : x_mm) {
    ServoRow& row = table.emplace_back();
    row.k = static_cast<std::int64_t>(table.size()) - 1;
    row.t = 0.1 * static_cast<double>(row.k);
    row.behaviour = 1;
    row.sac_seen = true;
    row.T_0E.p.x() = -1e-3 * x;
    row.true_e.p.x() = 1e-3 * x;
  }
  return table;
}

double figure(const ServoTable& table, const std::string& key) {
  const auto figures = figures_of(table);
  const auto found = figures.find(key);
  return found == figures.end() ? -1 : std::get<double>(found->second);
}

TEST(ServoFigures, AreOfTheTrueErrorOfAnObjectAtRest) {
  std::vector<double> x{300, 200, 100, -15, 10, -1.9, 1.5};
  for (int k = 0; k < 10; ++k) x.push_back(0.5);
  ServoTable table = approach(x);
  table.back().true_e.R = rotation_from_angle_axis({0, 0, std::numbers::pi / 180});
  EXPECT_NEAR(figure(table, "final_err_mm"), 0.5, 1e-9);
  EXPECT_NEAR(figure(table, "final_err_deg"), 0.1, 1e-9) << "one row of ten";
  EXPECT_NEAR(figure(table, "overshoot_pct"), 5, 1e-9);
  EXPECT_EQ(figure(table, "steps_to_2mm"), 5);
  EXPECT_NEAR(figure(table, "arm_moved_mm"), 315, 1e-9);
  EXPECT_EQ(figure(table, "unseen_pct"), 0);
  EXPECT_EQ(figure(table, "line_lag_mm"), -1) << "nothing moves";
}

TEST(ServoFigures, CountControlStepsFromTheFirstOneThatSees) {
  ServoTable table = approach({300, 300, 300, 100, 1, 1});
  for (std::size_t k = 0; k < 2; ++k) table[k].sac_seen = false;
  EXPECT_EQ(figure(table, "steps_to_2mm"), 2);
  EXPECT_NEAR(figure(table, "unseen_pct"), 100. / 3, 1e-9);
  EXPECT_TRUE(std::isnan(figure(approach({300, 100, 50}), "steps_to_2mm")));
}

TEST(ServoFigures, TellTheLagBehindAnObjectOnALine) {
  ServoTable table = approach(std::vector<double>(50, 7));
  for (ServoRow& row : table) {
    row.v = {0.1, 0, 0};
    row.true_e.p.y() = 1e-3;
    if (row.k < 20) row.true_e.p.x() = 0.1;  // still catching up
  }
  EXPECT_NEAR(figure(table, "line_lag_mm"), 7, 1e-9);
  EXPECT_NEAR(figure(table, "follow_err_mm"), std::hypot(7, 1), 1e-9);
  EXPECT_EQ(figure(table, "final_err_mm"), -1) << "it does not come to rest";
  for (ServoRow& row : table) row.v = {0.1 * std::cos(row.t), 0.1 * std::sin(row.t), 0};
  EXPECT_EQ(figure(table, "line_lag_mm"), -1) << "no line";
  EXPECT_NEAR(figure(table, "follow_err_mm"), std::hypot(7, 1), 1e-9);
}

TEST(ServoFigures, OfAnObjectThatIsNotThereAreThoseOfTheArm) {
  ServoTable table = approach({0, 3, 0});
  for (ServoRow& row : table) row.object_there = row.sac_seen = false;
  EXPECT_EQ(figure(table, "final_err_mm"), -1);
  EXPECT_NEAR(figure(table, "arm_moved_mm"), 3, 1e-9);
  EXPECT_EQ(figure(table, "unseen_pct"), 100);
  EXPECT_TRUE(figures_of({}).empty());
}

TEST(ServoTableFile, HasTheColumnsThatScriptsRelyOn) {
  ServoTable table = approach({300, 20});
  table[0].behaviour = 0;
  table[0].sac_seen = false;
  table[1].e = {rotation_from_angle_axis({0, 0, 0.5}), {0.01, 0.02, 0.03}};
  const auto file = std::filesystem::path(testing::TempDir()) / "servo.csv";
  write_servo_table(file, table);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "k,t,behaviour,sac_seen,eih_seen,err_x,err_y,err_z,err_angle,true_err_mm,true_err_deg");
  std::getline(in, line);
  EXPECT_EQ(line, "0,0.000,0,0,0,nan,nan,nan,nan,300.0000,0.0000");
  std::getline(in, line);
  EXPECT_EQ(line, "1,0.100,1,1,0,0.010000,0.020000,0.030000,0.500000,20.0000,0.0000");
  EXPECT_FALSE(std::getline(in, line));
}

}  // namespace
}  // namespace mrroc::visual_servo
