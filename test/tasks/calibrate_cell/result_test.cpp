#include "tasks/calibrate_cell/result.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/artefact.hpp"
#include "base/camera_config.hpp"
#include "launch/calibrated.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"

namespace mrroc::calibrate_cell {
namespace {

constexpr double kNothing = 1e-6;

Bases some_bases() {
  return {Pose{Matrix3::Identity(), {0, 2.1, 0}},
          Pose{rotation_from_angle_axis({0.002, -0.003, 0.004}), {0.003, 0.001, -0.004}}};
}

/// Both arms found these balls, without an error.
std::vector<mp::ArmTrace> traces(const std::array<ProbePlan, kArms>& plans) {
  std::vector<mp::ArmTrace> all(kArms);
  for (std::size_t arm = 0; arm < kArms; ++arm)
    for (std::size_t n = 0; n < touches(plans[arm]); ++n) {
      const ProbePlan& plan = plans[arm];
      const Vector3 middle = plan.balls[n / kTouchesPerBall] - (plan.ball_radius + plan.tip_radius) *
                                                                   in_base(direction(n), Matrix3::Identity());
      mp::ArmRow row;
      row.m = kFeel;
      all[arm].push_back(row);
      row.m = kMeasure;
      row.pose << middle + plan.tip_radius * Vector3::UnitZ(), 0, 0, 0;
      for (int k = 0; k < plan.readings; ++k) all[arm].push_back(row);
    }
  return all;
}

std::array<ProbePlan, kArms> plans_for(const Bases& bases) {
  std::array<ProbePlan, kArms> plans;
  for (std::size_t arm = 0; arm < kArms; ++arm)
    for (const Vector3& ball : {Vector3(0.3, 1, 0.8), Vector3(0.5, 1, 0.8), Vector3(0.3, 1.1, 1)})
      plans[arm].balls.push_back(bases[arm].inverse() * ball);
  return plans;
}

TEST(CalibrateCellResult, TellsWhereTheSecondBaseStandsWhateverWasBelieved) {
  const Bases real = some_bases();
  const auto plans = plans_for(real);
  const auto found = calibration_of(traces(plans), plans);
  ASSERT_TRUE(found);
  EXPECT_LT(distance(found->T_12.T_AB, relation(real)).mm, kNothing);
  const Bases believed{real[0] * Pose{rotation_from_angle_axis({0, 0, 0.01}), {0.005, 0, 0}}, Pose{}};
  const Bases now = corrected(believed, found->T_12.T_AB);
  EXPECT_TRUE(now[0].p == believed[0].p) << "the first one is kept";
  EXPECT_LT(distance(relation(now), relation(real)).mm, kNothing);
}

TEST(CalibrateCellResult, IsNothingWhenATouchIsMissing) {
  const auto plans = plans_for(some_bases());
  auto rows = traces(plans);
  rows[1].resize(rows[1].size() - static_cast<std::size_t>(plans[1].readings));
  EXPECT_FALSE(calibration_of(rows, plans));
  EXPECT_FALSE(calibration_of(std::vector<mp::ArmTrace>(kArms), plans)) << "nothing was done";
}

TEST(CalibrateCellResult, FiguresCompareWithTheTruth) {
  const Bases real = some_bases();
  const auto plans = plans_for(real);
  const auto found = calibration_of(traces(plans), plans);
  const Bases believed{real[0], real[1] * Pose{rotation_from_angle_axis({0, M_PI / 360, 0}), {0, 0.005, 0}}};
  const mp::TaskFigures f = figures(traces(plans), found->T_12.T_AB, believed, real);
  EXPECT_LT(std::get<double>(mp::figure(f, "base_err_mm")), kNothing);
  EXPECT_NEAR(std::get<double>(mp::figure(f, "base_before_mm")), 5, 1e-6);
  EXPECT_NEAR(std::get<double>(mp::figure(f, "base_before_deg")), 0.5, 1e-6);
  EXPECT_TRUE(std::isnan(std::get<double>(mp::figure(figures({{}, {}}, {}, believed, {}), "base_err_mm"))));
  EXPECT_LT(std::get<double>(mp::figure(touch_figures(found), "balls_rms_mm")), kNothing);
  EXPECT_TRUE(std::isnan(std::get<double>(mp::figure(touch_figures({}), "balls_rms_mm"))));
}

TEST(CalibrateCellResult, IsTakenByEveryTask) {
  const Bases bases = some_bases();
  const Pose T_EC{rotation_from_angle_axis({0.01, 0.02, -0.01}), {0.081, 0.001, -0.159}};
  const std::string text =
      as_toml({.bases = bases,
               .tools = {ecp::ForceTool{10.8, {0.004, 0, 0.156}}, ecp::ForceTool{11, Vector3::Zero()}},
               .sets = {"calibrated", "nominal"},
               .cameras = {{"eih", T_EC}},
               .ways = "both ways\nagree\n"},
              "runs/a");
  Config one_arm = Config::parse("seed = 1\n", "task");
  one_arm.overlay(Config::parse(text, "calibrated.toml"));
  std::ignore = one_arm.integer("seed", 1);
  EXPECT_THROW(one_arm.check_all_used(), ConfigError) << "a task without a cell asks for none of it";
  launch::take_calibrated(one_arm);
  EXPECT_NO_THROW(one_arm.check_all_used());
  const Config planner = Config::parse(text, "calibrated.toml");
  const Bases read = believed_bases(planner);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    EXPECT_LT(distance(read[arm], bases[arm]).mm, 1e-3);
    EXPECT_LT(distance(read[arm], bases[arm]).deg, 1e-4);
  }
  EXPECT_EQ(planner.number("robots.arm1.tool.weight", Config::kRequired), 10.8);
  EXPECT_EQ(planner.text("robots.arm1.kinematics", ""), "calibrated");
  Config with_camera =
      Config::parse("[cameras.eih]\nmount = 'arm1'\npose = [0.08, 0, -0.16, 0, 0, 0]\n", "task");
  with_camera.overlay(Config::parse(text, "calibrated.toml"));
  const CameraSetup camera = read_camera(with_camera, "eih");
  EXPECT_LT(distance(read_camera_place(with_camera, "eih"), {Matrix3::Identity(), {0.08, 0, -0.16}}).mm, 1e-6)
      << "where it truly is stays as it is";
  EXPECT_LT(distance(camera.place, T_EC).mm, 1e-3);
  EXPECT_LT(distance(camera.place, T_EC).deg, 1e-4);
}

TEST(CalibrateCellResult, OtherKeysOfSuchAFileAreErrorsAsEver) {
  const Config wrong = Config::parse(
      "[calibration]\nrun = 'a'\nrobots = ['arm1']\n[cell.robots.arm1]\nplcae = [0, 0, 0, 0, 0, 0]\n", "x");
  launch::take_calibrated(wrong);
  EXPECT_THROW(wrong.check_all_used(), ConfigError);
  const Config misspelt = Config::parse(
      "[calibration]\nrun = 'a'\nrobots = ['arm1']\n[robots.arn1]\nkinematics = 'nominal'\n", "x");
  launch::take_calibrated(misspelt);
  EXPECT_THROW(misspelt.check_all_used(), ConfigError) << "no arm of that name was calibrated";
  const Config not_one = Config::parse("[cell.robots.arm1]\nplace = [0, 0, 0, 0, 0, 0]\n", "x");
  launch::take_calibrated(not_one);
  EXPECT_THROW(not_one.check_all_used(), ConfigError) << "not left by a calibration";
}

Config cell() { return Config::parse(config(), "calibrate_cell.toml"); }

TEST(CalibrateCellSetup, BothArmsReachTheBallsAndBelieveThemInTheirOwnBases) {
  Config c = cell();
  complete(c);
  EXPECT_NO_THROW(check_reach(c));
  const auto artefact = read_artefact(c);
  const Bases bases = believed_bases(c);
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const ProbePlan plan = read_plan(c, kKeys[arm]);
    for (std::size_t k = 0; k < plan.balls.size(); ++k)
      EXPECT_LT((bases[arm] * plan.balls[k] - artefact->T_UA * artefact->balls[k]).norm(), 1e-5);
  }
}

TEST(CalibrateCellSetup, WhatCannotBeReachedOrTouchedIsRefused) {
  Config far = cell();
  far.set("artefact.place=[3, 1, 0.9, 0, 0, 0]");
  EXPECT_THROW(complete(far), FaultError);
  Config none = cell();
  none.set("artefact.balls=[]");
  EXPECT_THROW(complete(none), FaultError);
  Config odd = cell();
  odd.set("artefact.balls=[0, 0]");
  EXPECT_THROW(complete(odd), FaultError);
}

TEST(CalibrateCellSetup, CamerasThatAreLeftOutAreNoErrors) {
  Config c = cell();
  c.set("task.ways=touch");
  complete(c);
  EXPECT_TRUE(camera_keys(c).empty());
  Config one = cell();
  one.set("cameras.order=[\"eih\"]");
  complete(one);
  EXPECT_EQ(camera_keys(one), std::vector<std::string>{"eih"});
  EXPECT_EQ(one.text("cameras.sac.mount", ""), "arm1.base");
}

TEST(CalibrateCellSetup, TruthIsTheSimulators) {
  Config c = cell();
  c.set("sim.robots.arm2.base_error={ x = 0.003, az = 0.01 }");
  EXPECT_NEAR(distance(true_bases(c)[1], believed_bases(c)[1]).mm, 3, 1e-6);
}

}  // namespace
}  // namespace mrroc::calibrate_cell
