#include "tasks/rex_drive/figures.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string_view>

#include "tasks/rex_drive/plots.hpp"
#include "test/tasks/rex_drive/synthetic_drive.hpp"

namespace mrroc::rex_drive {
namespace {

double value(const mp::Figures& figures, const char* key) {
  const auto found = figures.find(key);
  EXPECT_NE(found, figures.end()) << key;
  return found == figures.end() ? 0 : std::get<double>(found->second);
}

TEST(RexFigures, AreWhatTheRowsTell) {
  const mp::Figures f = figures_of(synthetic_drive());
  EXPECT_NEAR(value(f, "track_rms_mm"), 10, 1e-9);
  EXPECT_NEAR(value(f, "track_max_mm"), 10, 1e-9);
  EXPECT_NEAR(value(f, "estimate_rms_mm"), 5, 1e-9);
  EXPECT_NEAR(value(f, "estimate_max_mm"), 5, 1e-9);
  EXPECT_EQ(f.count("return_kick_mps"), 0U);
  EXPECT_EQ(value(f, "ellipse_95_pct"), 100);
  EXPECT_NEAR(value(f, "friction_err"), 0.01, 1e-12);
  EXPECT_NEAR(value(f, "split_err"), 0.02, 1e-12);
  EXPECT_NEAR(value(f, "joint_speed_pct"), 100, 1e-9);
  EXPECT_NEAR(value(f, "plan_joint_speed_pct"), 100, 1e-9);
  EXPECT_NEAR(value(f, "ack_before_rest_s"), 205 * 0.02 - 2, 1e-9);
  EXPECT_NEAR(value(f, "speed_mean_mps"), kSpeed, 1e-9);
  EXPECT_NEAR(value(f, "drive_s"), 4, 1e-9);
  EXPECT_NEAR(value(f, "way_m"), 2, 0.02);
  EXPECT_EQ(value(f, "planner_iterations_p95"), 3);
  EXPECT_EQ(f.count("pivot_rms_mm"), 0U);
  EXPECT_EQ(f.count("friction_found_s"), 0U);
}

TEST(RexFigures, ErrorsOfTheSplitDoNotCancelInItsRootMeanSquare) {
  DriveResults r = synthetic_drive();
  for (std::size_t k = 0; k < r.table.size(); ++k) r.table[k].slip.split = k % 2 == 0 ? 0.03 : -0.03;
  const mp::Figures f = figures_of(r);
  EXPECT_NEAR(value(f, "split_rms"), 0.03, 1e-12);
  EXPECT_LT(value(f, "split_err"), 0.001) << "the means are equal";
}

TEST(RexFigures, APositionOfBeforeTheDriveIsNoLateOne) {
  DriveResults r = synthetic_drive();
  r.table.front().executing = 0;
  for (DriveRow& row : r.table) row.late_map = 1;
  EXPECT_EQ(value(figures_of(r), "late_map"), 0);
  r.table.back().late_map = 3;
  EXPECT_EQ(value(figures_of(r), "late_map"), 2);
}

TEST(RexFigures, AnEstimateFarAwayIsOutsideOfItsEllipse) {
  EXPECT_EQ(value(figures_of(synthetic_drive(0.1)), "ellipse_95_pct"), 0);
}

TEST(RexFigures, TheEndIsJudgedWhenThePlanHasComeToItsEnd) {
  DriveResults r = synthetic_drive();
  const PlanarPose end = r.fragments.back().fragment.knot.back().p;
  r.table.back().truth.p = {end.x + 0.03, end.y - 0.04, 1};
  EXPECT_NEAR(value(figures_of(r), "end_error_mm"), 50, 1e-9);
  r.acked_in = 0;
  EXPECT_EQ(figures_of(r).count("end_error_mm"), 0U) << "it has not come so far";
}

// A position that is told at 1 s is in the driver's hands at 1.04 s.
TEST(RexFigures, TheKickIsTheChangeOfSpeedShortlyAfterTheMapIsBack) {
  const auto kick = [](double from, double to) {
    DriveResults r = synthetic_drive();
    r.map_returns = {1};
    for (DriveRow& row : r.table)
      if (row.t > from && row.t < to) row.truth.v.vx += 0.3;
    return value(figures_of(r), "return_kick_mps");
  };
  EXPECT_NEAR(kick(9, 9), 0, 1e-9);
  EXPECT_NEAR(kick(1.19, 1.21), 0.3, 1e-9);
  EXPECT_NEAR(kick(1.23, 1.25), 0.3, 1e-9);
  EXPECT_NEAR(kick(1.25, 1.9), 0, 1e-9) << "later";
  EXPECT_NEAR(kick(0.1, 0.99), 0, 1e-9) << "before";
}

TEST(RexFigures, ASpeedThatIsPlannedIsNoKick) {
  DriveResults r = synthetic_drive();
  r.map_returns = {1};
  for (DriveRow& row : r.table) {
    if (row.t <= 1.1) continue;
    row.truth.v.vx = 0.2;
    row.reference.x = kSpeed * 1.1 + 0.2 * (row.t - 1.1);
  }
  EXPECT_LT(value(figures_of(r), "return_kick_mps"), 0.02);
}

TEST(RexFigures, ASlowJointShows) {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table)
    if (row.t > 1.9 && row.t < 2.1) row.truth.v.vx = 0.2;
  const mp::Figures f = figures_of(r);
  EXPECT_NEAR(value(f, "joint_speed_pct"), 40, 1e-9);
  EXPECT_NEAR(value(f, "plan_joint_speed_pct"), 40, 1e-9);
}

TEST(RexFigures, AJointNearAPauseIsNotJudged) {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table) {
    if (row.t > 1.5 && row.t < 1.8) row.pace = 0.5;
    if (row.t > 1.5 && row.t < 2.1) row.truth.v.vx = 0.2;
  }
  mp::Figures f = figures_of(r);
  EXPECT_EQ(f.count("joint_speed_pct"), 0U);
  EXPECT_EQ(f.count("plan_joint_speed_pct"), 0U);
  for (DriveRow& row : r.table) row.pace = row.t < 0.71 || row.t > 2.1 ? 0 : 1;
  f = figures_of(r);
  EXPECT_NEAR(value(f, "joint_speed_pct"), 40, 1e-9) << "the pauses are long before it and behind it";
  for (DriveRow& row : r.table) row.pace = row.t < 0.85 ? 0 : 1;
  EXPECT_EQ(figures_of(r).count("joint_speed_pct"), 0U) << "1.15 s after a pause";
}

// The pace comes back in 0.2 s, or by 2 m/s^2; a second later the speed is the planned one.
TEST(RexFigures, TheFasterAJointIsPlannedTheLongerAfterAPauseItIsNotJudged) {
  struct Case {
    double planned;  // [m/s]
    double settles;  // [s]
  };
  for (const Case& c : {Case{0.2, 1.2}, Case{0.8, 1.4}, Case{1.4, 1.7}}) {
    DriveResults r = synthetic_drive();
    r.fragments[0].fragment.knot.back().v = c.planned;
    const auto judged_after = [&r](double paused_until) {
      for (DriveRow& row : r.table) row.pace = row.t < paused_until ? 0 : 1;
      return figures_of(r).count("joint_speed_pct") == 1;
    };
    EXPECT_FALSE(judged_after(2 - c.settles + 0.1)) << c.planned;
    EXPECT_TRUE(judged_after(2 - c.settles - 0.1)) << c.planned;
  }
}

TEST(RexFigures, AJointOfPlansIsJudgedByTheSpeedPlannedThere) {
  DriveResults r = synthetic_drive();
  for (Plan& plan : r.plans) plan.speed = 2 * kSpeed;  // wanted, which a curve at the joint does not allow
  EXPECT_NEAR(value(figures_of(r), "plan_joint_speed_pct"), 100, 1e-9);
}

TEST(RexFigures, OfDrivesThatDifferDifferentThingsAreWanted) {
  const auto wanted = [](DriveCase drive, const char* key) {
    const auto infos = figures_of_case(drive);
    return mp::wanted(*std::ranges::find(infos, std::string_view(key), &mp::FigureInfo::key));
  };
  EXPECT_EQ(wanted(DriveCase::usual, "track_rms_mm"), "<= 10");
  EXPECT_EQ(wanted(DriveCase::usual, "joint_speed_pct"), ">= 90");
  EXPECT_EQ(wanted(DriveCase::own_plan, "track_rms_mm"), "<= 10");
  EXPECT_EQ(wanted(DriveCase::own_plan, "estimate_rms_mm"), "<= 8");
  for (const char* key : {"joint_speed_pct", "plan_joint_speed_pct", "ack_before_rest_s"})
    EXPECT_EQ(wanted(DriveCase::own_plan, key), "") << key;
  EXPECT_EQ(wanted(DriveCase::fast, "track_max_mm"), "<= 100");
  for (const DriveCase ground : {DriveCase::slippery, DriveCase::ice_right}) {
    EXPECT_EQ(wanted(ground, "track_rms_mm"), "<= 15");
    EXPECT_EQ(wanted(ground, "track_max_mm"), "");
  }
  EXPECT_EQ(wanted(DriveCase::smooth, "split_err"), "<= 0.02");
  for (const mp::FigureInfo& info : figures_of_case(DriveCase::other))
    EXPECT_EQ(mp::wanted(info).empty(), info.key != "planner_iterations_p95" && info.key != "solver_failures")
        << info.key;
}

TEST(RexFigures, AStopIsJudgedWhereGroundAndSpeedAllowItAndToldOfEveryDrive) {
  for (const DriveCase drive : {DriveCase::usual, DriveCase::own_plan, DriveCase::fast, DriveCase::slippery,
                                DriveCase::ice_right, DriveCase::smooth, DriveCase::other}) {
    const auto infos = figures_of_case(drive);
    const auto stop = std::ranges::find(infos, std::string_view("stop_steps_max"), &mp::FigureInfo::key);
    ASSERT_NE(stop, infos.end());
    const bool judged = drive == DriveCase::usual || drive == DriveCase::own_plan;
    EXPECT_EQ(mp::wanted(*stop), judged ? "<= 300" : "") << static_cast<int>(drive);
    EXPECT_TRUE(stop->always) << static_cast<int>(drive);
  }
}

TEST(RexFigures, OfADriveWithoutWishesItIsSaidWhatAloneIsWanted) {
  EXPECT_NE(wanted_only(DriveCase::other).find("nothing is wanted of this drive but"), std::string::npos);
  for (const DriveCase drive : {DriveCase::usual, DriveCase::own_plan, DriveCase::fast, DriveCase::smooth})
    EXPECT_EQ(wanted_only(drive), "");
}

/// A drive whose ground is half as rough from 1 s on, which is found at 1.6 s.
DriveResults drive_onto_ice() {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table) {
    if (row.t >= 1)
      for (auto& friction : row.truth.friction) friction = {0.35, 0.3};
    if (row.t >= 1.6) row.slip = {0.36, 0.29, 0.02};
  }
  return r;
}

TEST(RexFigures, AChangeOfTheGroundIsFoundWhenTheEstimateIsNear) {
  EXPECT_NEAR(value(figures_of(drive_onto_ice()), "friction_found_s"), 0.6, 0.021);
}

TEST(RexFigures, AChangeOfTheGroundIsNotFoundWhileAnyOfItIsFar) {
  for (const auto coefficient : {&Slip::mu_x, &Slip::mu_y, &Slip::split}) {
    DriveResults r = drive_onto_ice();
    for (DriveRow& row : r.table)
      if (row.t >= 1.6 && row.t < 2.2) row.slip.*coefficient += 0.15;
    EXPECT_NEAR(value(figures_of(r), "friction_found_s"), 1.2, 0.021);
  }
}

TEST(RexFigures, AChangeOfTheGroundIsFoundWhenTheEstimateStaysNear) {
  DriveResults r = drive_onto_ice();
  for (DriveRow& row : r.table)
    if (row.t >= 2.2 && row.t < 2.3) row.slip.mu_x = 0.5;
  EXPECT_NEAR(value(figures_of(r), "friction_found_s"), 1.3, 0.021) << "it was near before, and left again";
  DriveResults late = r;
  for (DriveRow& row : late.table)
    if (row.t >= 3.4) row.slip.mu_x = 0.5;
  EXPECT_NEAR(value(figures_of(late), "friction_found_s"), 1.3, 0.021) << "it has stayed for a second";
  for (DriveRow& row : r.table)
    if (row.t >= 2.8) row.slip.mu_x = 0.5;
  EXPECT_EQ(figures_of(r).count("friction_found_s"), 0U) << "it is far to the end of the drive";
}

TEST(RexFigures, TheNextChangeOfTheGroundEndsTheSearch) {
  DriveResults r = drive_onto_ice();
  for (DriveRow& row : r.table)
    if (row.t >= 2.5)
      for (auto& friction : row.truth.friction) friction = {0.7, 0.6};
  EXPECT_NEAR(value(figures_of(r), "friction_found_s"), 0.6, 0.021);
}

TEST(RexFigures, AChangeAcrossOrOfTheSplitIsAChangeOfTheGround) {
  DriveResults across = synthetic_drive(), split = synthetic_drive();
  for (DriveRow& row : across.table)
    if (row.t >= 1)
      for (auto& friction : row.truth.friction) friction[1] = 0.4;
  EXPECT_EQ(figures_of(across).count("friction_found_s"), 0U);
  for (DriveRow& row : across.table)
    if (row.t >= 2) row.slip.mu_y = 0.4;
  EXPECT_NEAR(value(figures_of(across), "friction_found_s"), 1, 0.021);
  for (DriveRow& row : split.table) {
    if (row.t >= 1) {
      for (const std::size_t left : {0U, 2U}) row.truth.friction[left][0] = 0.98;
      for (const std::size_t right : {1U, 3U}) row.truth.friction[right][0] = 0.42;
    }
    if (row.t >= 1.5) row.slip.split = 0.38;
  }
  EXPECT_NEAR(value(figures_of(split), "friction_found_s"), 0.5, 0.021);
}

TEST(RexFigures, OfARunWithoutRowsAreFew) {
  const mp::Figures f = figures_of({});
  EXPECT_EQ(f.count("track_rms_mm"), 0U);
  EXPECT_EQ(f.count("ack_before_rest_s"), 0U);
}

TEST(RexTables, HaveARowPerMacrostepAndPerFragment) {
  const DriveResults r = synthetic_drive();
  const auto folder = std::filesystem::temp_directory_path();
  const auto lines = [](const std::filesystem::path& file) {
    std::ifstream in(file);
    std::vector<std::string> all;
    for (std::string line; std::getline(in, line);) all.push_back(line);
    return all;
  };
  write_drive_table(folder / "rex_platform.csv", r.table);
  write_fragment_table(folder / "rex_fragments.csv", r.fragments, r.table);
  const auto rows = lines(folder / "rex_platform.csv"), fragments = lines(folder / "rex_fragments.csv");
  ASSERT_EQ(rows.size(), 251U);
  for (const std::string& row : rows)
    EXPECT_EQ(std::ranges::count(row, ','), std::ranges::count(rows[0], ','));
  ASSERT_EQ(fragments.size(), 3U);
  EXPECT_EQ(fragments[1], "1,1,100,46,0.20,0.00,2.00,0.5000,0.5000,0.92");
  std::filesystem::remove(folder / "rex_platform.csv");
  std::filesystem::remove(folder / "rex_fragments.csv");
}

TEST(RexPlots, ReadTheColumnsThatTheTableHas) {
  const auto pictures = plots(synthetic_drive());
  ASSERT_EQ(pictures.size(), 5U);
  for (const auto& [name, script] : pictures) {
    EXPECT_NE(script.find("plots/" + name + ".png"), std::string::npos);
    EXPECT_TRUE(script.find("platform.csv") != std::string::npos ||
                script.find("fragments.csv") != std::string::npos);
  }
}

TEST(RexPlots, WithEyesThereIsAPictureOfTheOdometryButOfErrorsOnlyWhenThereAreAny) {
  DriveResults r = synthetic_drive();
  for (const bool valid : {true, false}) {
    r.odometry = {{.t = 1}, {.t = 2, .valid = valid}};
    const auto pictures = plots(r);
    const auto found = std::ranges::find(pictures, "odometry", [](const auto& p) { return p.first; });
    ASSERT_NE(found, pictures.end());
    const auto draws = [&](const char* columns) {
      return found->second.find(std::string("'odometry.csv' skip 1 using ") + columns) != std::string::npos;
    };
    EXPECT_TRUE(draws("1:6"));
    EXPECT_EQ(draws("1:17"), valid);
    EXPECT_EQ(draws("1:19"), valid);
  }
}

TEST(RexFigures, OfABlindPlatformAreToldAndNotAsWanted) {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table) row.late_odometry = row.t > 1 ? 2 : 0;
  for (int k = 0; k < 20; ++k) r.odometry.push_back({.t = 0.08 * k, .drives = true});
  const mp::Figures f = figures_of(r);
  EXPECT_EQ(value(f, "odometry_valid_pct"), 0);
  EXPECT_EQ(value(f, "late_odometry"), 2);
  EXPECT_EQ(figures_of(synthetic_drive()).count("late_odometry"), 0U) << "it has no eyes";
  const auto missed = mp::judge(f, figures_of_case(DriveCase::usual)).missed;
  EXPECT_TRUE(std::ranges::any_of(
      missed, [](const std::string& m) { return m.starts_with("odometry_valid_pct 0"); }));
}

TEST(RexPlots, ADriveWithoutFragmentsHasNoHandover) {
  DriveResults r = synthetic_drive();
  r.fragments.clear();
  const auto pictures = plots(r);
  EXPECT_EQ(pictures.size(), 4U);
  EXPECT_TRUE(std::ranges::none_of(pictures, [](const auto& p) { return p.first == "handover"; }));
}

TEST(RexPlots, TheHandoverShowsStepsAndNotifyOfEachFragmentAndWhenTheDriverIsReady) {
  const auto pictures = plots(synthetic_drive());
  const std::string script =
      std::ranges::find(pictures, "handover", [](const auto& p) { return p.first; })->second;
  for (const char* curve : {"'fragments.csv' skip 1 using 10:1", "'fragments.csv' skip 1 using 6:3",
                            "'fragments.csv' skip 1 using 6:4"})
    EXPECT_NE(script.find(curve), std::string::npos) << curve;
}

TEST(RexTables, TellWhenTheDriverWasReadyForTheNextFragmentIfItWas) {
  DriveResults r = synthetic_drive();
  for (DriveRow& row : r.table) row.notified = std::min<std::int64_t>(row.notified, 1);
  const std::vector<Stay> times = stays(r.fragments, r.table);
  EXPECT_NEAR(times[0].ready, 0.92, 1e-9);
  EXPECT_TRUE(std::isnan(times[1].ready));
}

TEST(RexPlots, TintAWholeSlipperyFloorOtherwiseAndTellEqualAreasOnceInTheRoom) {
  DriveResults r = synthetic_drive();
  r.room = built_in_room();
  const auto floor = [&r](double friction) {
    r.ground.friction = {friction, friction};
    const std::string path = plots(r).front().second;
    const auto at = path.find("fillcolor rgb '");
    return path.substr(at, 26);
  };
  EXPECT_NE(floor(0.7), floor(0.35));
  r.ground.areas = {{.lower = {-9, -2}, .upper = {0, 0}, .scale = 0.5},
                    {.lower = {1, 1}, .upper = {9, 9}, .scale = 0.5}};
  const std::string path = plots(r).front().second;
  EXPECT_EQ(path.find("area x 0.5: "), path.rfind("area x 0.5: "));
  EXPECT_NE(path.find("rectangle from 1,1 to 3,2 "), std::string::npos) << "no farther than the walls";
}

TEST(RexPlots, ShowTheRoomAndItsGround) {
  DriveResults r = synthetic_drive();
  r.room = built_in_room();
  r.ground = {.friction = {0.7, 0.6},
              .areas = {{.lower = {-3, -2}, .upper = {3, 0}, .scale = 0.5, .from = 7}}};
  const std::string path = plots(r).front().second;
  for (const char* part : {"title 'floor: friction 0.7 along, 0.6 across'",
                           "title 'area x 0.5 from 7 s on: friction 0.35 along, 0.3 across'",
                           "rectangle from -3,-2 to 3,2 fillcolor", "rectangle from -3,-2 to 3,0 fillcolor"})
    EXPECT_NE(path.find(part), std::string::npos) << part;
  const auto polygons = [&path] {
    std::size_t n = 0;
    for (std::size_t at = path.find("polygon"); at != std::string::npos; at = path.find("polygon", at + 1))
      ++n;
    return n;
  };
  EXPECT_EQ(polygons(), r.room.obstacles.size());
  EXPECT_NE(path.find("set xrange [-3.1:3.1]"), std::string::npos);
}

}  // namespace
}  // namespace mrroc::rex_drive
