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
    row.known_e.p.x() = row.true_e.p.x() = 1e-3 * x;
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
  table.back().known_e.R = rotation_from_angle_axis({0, 0, std::numbers::pi / 180});
  EXPECT_NEAR(figure(table, "final_err_mm"), 0.5, 1e-9);
  EXPECT_NEAR(figure(table, "final_err_deg"), 0.1, 1e-9) << "one row of ten";
  EXPECT_NEAR(figure(table, "overshoot_pct"), 5, 1e-9);
  EXPECT_EQ(figure(table, "steps_to_2mm"), 5);
  EXPECT_NEAR(figure(table, "arm_moved_mm"), 315, 1e-9);
  EXPECT_EQ(figure(table, "unseen_pct"), 0);
  EXPECT_EQ(figure(table, "line_lag_mm"), -1) << "nothing moves";
}

TEST(ServoFigures, JudgeTheEndByWhatTheToolsCameraCanKnow) {
  ServoTable table = approach({300, 100, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
  for (ServoRow& row : table) row.true_e.p.y() = 5e-3;
  EXPECT_NEAR(figure(table, "final_err_mm"), 1, 1e-9);
  EXPECT_NEAR(figure(table, "true_err_mm"), std::hypot(1, 5), 1e-9);
  EXPECT_EQ(figure(table, "steps_to_2mm"), 2);
}

TEST(ServoFigures, TellHowFarTheSetPoseGoesInAStepAfterAChangeOfCameras) {
  ServoTable table = approach(std::vector<double>(30, 1));
  for (ServoRow& row : table) row.set_step = 9e-3;
  EXPECT_EQ(figure(table, "camera_change_mm"), -1) << "always the same one";
  for (std::size_t k = 10; k < 30; ++k) table[k].behaviour = k < 12 ? 0 : 3;
  for (std::size_t k = 12; k < 17; ++k) table[k].set_step = 1e-4 * static_cast<double>(k);
  EXPECT_NEAR(figure(table, "camera_change_mm"), 1.6, 1e-9) << "idle is no camera; half a second counts";
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

TEST(ServoFigures, CountRefusalsOnlyWhenThereAreAny) {
  ServoTable table = approach({300, 200, 100});
  EXPECT_EQ(figure(table, "refused_steps"), -1);
  table[0].refused = table[2].refused = true;
  EXPECT_EQ(figure(table, "refused_steps"), 2);
}

TEST(ServoFigures, OneCameraIsEnoughToSee) {
  ServoTable table = approach({300, 200, 100, 50});
  for (ServoRow& row : table) std::swap(row.sac_seen, row.eih_seen);
  table[1].eih_seen = false;
  table[2].sac_seen = true;
  EXPECT_EQ(figure(table, "unseen_pct"), 25);
}

TEST(ServoFigures, TwoMillimetresAreNotBelowTwo) {
  EXPECT_EQ(figure(approach({300, 1.9, 1.9, 1.9}), "steps_to_2mm"), 1);
  EXPECT_EQ(figure(approach({300, 2.1, 1.9, 1.9}), "steps_to_2mm"), 2);
  EXPECT_TRUE(std::isnan(figure(approach({300, 1, 2.1}), "steps_to_2mm")));
  EXPECT_EQ(figure(approach({1, 1, 1}), "steps_to_2mm"), 0);
}

TEST(ServoFigures, OvershootIsAlongTheWayFromTheFirstPlaceThatWasSeen) {
  ServoTable table = approach({-900, 200, 0, -10, 0});
  table[0].sac_seen = false;
  table[3].true_e.p.y() = 0.5;  // sideways does not count
  EXPECT_NEAR(figure(table, "overshoot_pct"), 5, 1e-9);
  EXPECT_EQ(figure(approach({300, 200, 100}), "overshoot_pct"), 0);
  table = approach({200, 0, -10, 0});
  for (ServoRow& row : table) {
    row.T_0E.R = rotation_from_angle_axis({0, 0, std::numbers::pi / 2});
    row.true_e.p = row.T_0E.R.transpose() * row.true_e.p;
  }
  EXPECT_NEAR(figure(table, "overshoot_pct"), 5, 1e-9) << "whatever the orientation";
}

TEST(ServoFigures, OfAnObjectThatComesToRestAreThoseOfItsMotionAndOfItsEnd) {
  ServoTable table = approach(std::vector<double>(60, 7));
  for (ServoRow& row : table) {
    if (row.k < 45) row.v = {0, 0.1, 0};
    if (row.k < 20) row.true_e.p.x() = 0.1;
    if (row.k >= 45) row.known_e.p.x() = 3e-3;
  }
  EXPECT_NEAR(figure(table, "follow_err_mm"), 7, 1e-9) << "the last two seconds of the motion";
  EXPECT_NEAR(figure(table, "final_err_mm"), 3, 1e-9);
  EXPECT_EQ(figure(table, "overshoot_pct"), -1) << "it has moved";
  EXPECT_EQ(figure(table, "steps_to_2mm"), -1);
  EXPECT_NEAR(figure(table, "line_lag_mm"), 0, 1e-9) << "the error is across the line";
}

TEST(ServoFigures, ALineMayTurnByTwoDegreesAndNoMore) {
  const auto lag = [](double degrees) {
    ServoTable table = approach(std::vector<double>(10, 7));
    for (ServoRow& row : table) row.v = {0.1, 0, 0};
    const double a = degrees * std::numbers::pi / 180;
    table.back().v = {0.2 * std::cos(a), 0.2 * std::sin(a), 0};
    return figure(table, "line_lag_mm");
  };
  EXPECT_NEAR(lag(2), 7, 1e-9);
  EXPECT_EQ(lag(3), -1);
  EXPECT_EQ(lag(180), -1);
}

TEST(ServoTableFile, LeavesOutTheTruthOfAnObjectThatIsNotThereAndTellsAnglesInDegrees) {
  ServoTable table = approach({0, 0});
  table[0].object_there = false;
  table[1].true_e.R = rotation_from_angle_axis({0, std::numbers::pi / 6, 0});
  table[1].true_e.p = {0.003, 0, 0.004};
  table[1].eih_seen = true;
  const auto file = std::filesystem::path(testing::TempDir()) / "servo_truth.csv";
  write_servo_table(file, table);
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::getline(in, line);
  EXPECT_EQ(line, "0,0.000,1,1,0,0.000000,0.000000,0.000000,0.000000,nan,nan");
  std::getline(in, line);
  EXPECT_EQ(line, "1,0.100,1,1,1,0.000000,0.000000,0.000000,0.000000,5.0000,30.0000");
}

}  // namespace
}  // namespace mrroc::visual_servo
