#include "tasks/rex_drive/figure_notes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "test/tasks/rex_drive/synthetic_drive.hpp"

namespace mrroc::rex_drive {
namespace {

std::vector<std::string> missed(const mp::Figures& figures, DriveCase drive, const FigureContext& context) {
  std::vector<std::string> keys;
  for (const std::string& line : mp::judge(figures, figures_of_run(drive, figures, context)).missed)
    keys.push_back(line.substr(0, line.find(' ')));
  return keys;
}

/// A drive during which the estimator was unsure of the friction by so much.
mp::Figures figures_with(double sd) {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table) row.slip_sd = {sd, sd, sd};
  return figures_of(r);
}

TEST(FigureNotes, FrictionThatNothingTellsOfIsNotMeasuredAndSaysWhy) {
  const mp::Figures unsure = figures_with(0.14);
  for (const char* key : {"friction_err", "split_err", "split_rms"})
    EXPECT_TRUE(std::isnan(std::get<double>(unsure.at(key)))) << key;
  EXPECT_NE(figure_notes(unsure, {}).find("friction -: wheels that roll straight on"), std::string::npos);
  EXPECT_TRUE(missed(unsure, DriveCase::smooth, {.smooth = true}).empty())
      << "nothing is wanted of what was not measured";
}

TEST(FigureNotes, FrictionThatWasFoundIsExplainedWhereItIsNotTheTrueOne) {
  const mp::Figures sure = figures_with(0.03);
  EXPECT_NEAR(std::get<double>(sure.at("friction_err")), 0.01, 1e-12);
  EXPECT_NE(figure_notes(sure, {}).find("friction: what is found is an effective value"), std::string::npos);
  EXPECT_EQ(figure_notes(sure, {.smooth = true}), "");
  EXPECT_EQ(figure_notes({}, {}), "") << "a drive without figures";
}

TEST(FigureNotes, NothingIsWantedOfOdometryWhoseCamerasWereToldToBeWorse) {
  mp::Figures figures = figures_with(0.03);
  figures["odometry_valid_pct"] = 52.4;
  figures["odometry_drift_pct"] = 3.0;
  EXPECT_EQ(missed(figures, DriveCase::usual, {}),
            (std::vector<std::string>{"odometry_valid_pct", "odometry_drift_pct"}));
  const FigureContext black{.smooth = true, .eyes = {"cameras.rex_left.black"}};
  EXPECT_TRUE(missed(figures, DriveCase::usual, black).empty());
  EXPECT_EQ(figure_notes(figures, black),
            "odometry: nothing is wanted of it, since cameras.rex_left.black was set\n");
  figures["track_rms_mm"] = 1000.0;
  EXPECT_EQ(missed(figures, DriveCase::usual, black), std::vector<std::string>{"track_rms_mm"})
      << "the drive is judged as ever";
}

}  // namespace
}  // namespace mrroc::rex_drive
