// The platform's task as a user starts it: plans, a map that is lost, processes that die, plans that are refused.
#include <gtest/gtest.h>
#include <csignal>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <fstream>
#include <sstream>
#include <thread>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

/// Two legs with a curve between them; a shorter way where every step takes long.
constexpr const char* kTwoLegs = kSanitized ? "0 0\n0.5 0\n0.9 0.2\n" : "0 0\n0.7 0\n1.2 0.3\n1.4 0.9\n";

/// A drive that sees.
std::vector<std::string> see_along(const Folder& folder, const std::string& name = "run") {
  return {"--plan", folder.write("plan.txt", kTwoLegs), "--run-dir", (folder / name).string()};
}
/// The same without eyes, which takes less time.
std::vector<std::string> drive_along(const Folder& folder, const std::string& name = "run") {
  return words({see_along(folder, name), {"--eyes", "off"}});
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// A column of a table with a line of names.
std::vector<double> column_of(const fs::path& file, const std::string& name) {
  std::ifstream in(file);
  std::string line, cell;
  std::getline(in, line);
  std::istringstream names(line);
  int at = 0;
  while (std::getline(names, cell, ',') && cell != name) ++at;
  std::vector<double> values;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    for (int k = 0; k <= at; ++k) std::getline(cells, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

TEST(RexDrive, DrivesAPlanWithTheSameBitsInOneProcessAndInSeveral) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder;
  nlohmann::json told[2];
  for (const bool one : {false, true}) {
    const std::string name = one ? "one" : "separate";
    const Ended ended = run(folder, "rex_drive", words({drive_along(folder, name), {"--processes", name}}));
    ASSERT_EQ(ended.status, 0) << ended.all();
    told[one ? 1 : 0] = summary(folder / name);
  }
  EXPECT_NE(told[0].at("log_hash"), "0000000000000000");
  EXPECT_EQ(told[0].at("log_hash"), told[1].at("log_hash"));
  EXPECT_EQ(told[0].at("figures"), told[1].at("figures"));
  EXPECT_EQ(bytes_of(folder / "one" / "platform.csv"), bytes_of(folder / "separate" / "platform.csv"));
  EXPECT_LE(figure(told[0], "track_rms_mm"), 15);
  EXPECT_LE(figure(told[0], "estimate_rms_mm"), 12);
  EXPECT_EQ(figure(told[0], "solver_failures"), 0);
}

/// They take little time.
std::vector<std::string> small_pictures() {
  std::vector<std::string> words;
  for (const char* const camera : {"rex_left", "rex_right"})
    for (const char* const setting : {"width=320", "height=240", "fx=210"})
      words.insert(words.end(), {"--set", std::string("cameras.") + camera + "." + setting});
  return words;
}

TEST(RexDrive, SeesItsMotionWithTheSameBitsInOneProcessAndInSeveral) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder;
  nlohmann::json told[2];
  for (const bool one : {false, true}) {
    const std::string name = one ? "one" : "separate";
    const Ended ended =
        run(folder, "rex_drive", words({see_along(folder, name), small_pictures(), {"--processes", name}}));
    ASSERT_EQ(ended.status, 0) << ended.all();
    told[one ? 1 : 0] = summary(folder / name);
  }
  EXPECT_NE(told[0].at("log_hash"), "0000000000000000");
  EXPECT_EQ(told[0].at("log_hash"), told[1].at("log_hash"));
  EXPECT_LE(figure(told[0], "estimate_rms_mm"), 12);
  EXPECT_EQ(told[0].at("figures"), told[1].at("figures"));
  EXPECT_EQ(bytes_of(folder / "one" / "odometry.csv"), bytes_of(folder / "separate" / "odometry.csv"));
  EXPECT_GE(column_of(folder / "one" / "odometry.csv", "valid").size(), 40U) << "a pair every 80 ms";
  EXPECT_GE(figure(told[0], "odometry_valid_pct"), 95);
  EXPECT_LE(figure(told[0], "odometry_rms_mm"), 0.5);
  EXPECT_LE(figure(told[0], "odometry_turn_rms_mrad"), 0.5);
  EXPECT_EQ(figure(told[0], "late_odometry"), 0);
  EXPECT_TRUE(fs::exists(folder / "one" / "rex_odometry.png")) << "what the left camera saw";
}

/// Something that is wrong with the cameras, and what is told of it.
struct Blindness {
  const char* name;
  std::vector<std::string> settings;
  const char* told;
  bool whole{};            ///< all the way; else from 1.5 s to 5 s
  bool found_by_wheels{};  ///< the odometry itself measures, and is not believed
};

class RexDriveWithACameraThat : public ::testing::TestWithParam<Blindness> {};

TEST_P(RexDriveWithACameraThat, DrivesOnAndTellsWhy) {
  const Folder folder;
  const Blindness& k = GetParam();
  std::vector<std::string> wrong;
  for (const std::string& setting : k.settings) wrong.insert(wrong.end(), {"--set", setting});
  const Ended ended =
      run(folder, "rex_drive", words({see_along(folder), small_pictures(), {"--processes", "one"}, wrong}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_NE(ended.all().find(std::string("odometry sees nothing for 2 s: ") + k.told), std::string::npos)
      << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_EQ(told.at("outcome"), "done");
  EXPECT_LE(figure(told, "track_max_mm"), 60);
  EXPECT_LE(figure(told, "estimate_rms_mm"), 12);
  if (k.found_by_wheels) return;
  const double seen = figure(told, "odometry_valid_pct");
  if (k.whole)
    EXPECT_EQ(seen, 0);
  else
    EXPECT_GT(seen, 5);
  EXPECT_LT(seen, 70);
  EXPECT_EQ(ended.all().find("NOT OK"), std::string::npos) << "what was ordered and survived\n"
                                                           << ended.all();
  EXPECT_NE(ended.all().find("odometry: nothing is wanted of it, since cameras."), std::string::npos)
      << ended.all();
}

INSTANTIATE_TEST_SUITE_P(
    Is, RexDriveWithACameraThat,
    ::testing::Values(
        Blindness{"silent", {"cameras.rex_right.silent=[1.5, 5]"}, "a camera gives no picture"},
        Blindness{"black", {"cameras.rex_left.black=[1.5, 5]"}, "a picture is nearly black"},
        Blindness{"frozen", {"cameras.rex_left.frozen=[1.5, 5]"}, "a picture is the very same as before"},
        Blindness{"silent_both",
                  {"cameras.rex_left.silent=[1.5, 5]", "cameras.rex_right.silent=[1.5, 5]"},
                  "a camera gives no picture"},
        Blindness{"black_both",
                  {"cameras.rex_left.black=[1.5, 5]", "cameras.rex_right.black=[1.5, 5]"},
                  "a picture is nearly black"},
        Blindness{"frozen_both",
                  {"cameras.rex_left.frozen=[1.5, 5]", "cameras.rex_right.frozen=[1.5, 5]"},
                  "a picture is the very same as before"},
        Blindness{"hanging",
                  {"cameras.rex_right.hangs=[1.5, 5]"},
                  "what one picture shows is not found in the others"},
        Blindness{"hanging_both",
                  {"cameras.rex_left.hangs=[1.5, 5]", "cameras.rex_right.hangs=[1.5, 5]"},
                  "the wheels turn, and its pictures stand still",
                  false,
                  true},
        Blindness{"exchanged",
                  {"cameras.rex_left.shows=\"rex_right\"", "cameras.rex_right.shows=\"rex_left\""},
                  "left and right are exchanged",
                  true},
        Blindness{"in_the_dark", {"cameras.light.exposure=0.01"}, "a picture is nearly black", true}),
    [](const auto& blindness) { return std::string(blindness.param.name); });

TEST(RexDrive, HoldsItsWayByItsEyesWhenTheMapIsGone) {
  const Folder folder;
  const Ended ended = run(folder, "rex_drive",
                          words({see_along(folder),
                                 small_pictures(),
                                 {"--processes", "one", "--set", "motion_capture.lost=[1.5, 100]"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "estimate_max_mm"), 25);
}

// The map comes back 0.2 m beside where it was.
TEST(RexDrive, IsNotKickedByAMapThatComesBack) {
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          words({see_along(folder),
                 small_pictures(),
                 {"--processes", "one", "--set", "motion_capture.lost=[1.5, 2.5]", "--set",
                  "motion_capture.displaced=[2.5, 100]", "--set", "motion_capture.offset=[0, 0.2, 0]"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_GT(figure(told, "map_rejected"), 0);
  EXPECT_LE(figure(told, "return_kick_mps"), 0.1);
}

// The map jumps while it is seen: along the way, across it, and turned.
TEST(RexDrive, IsNotKickedByAMapThatJumps) {
  const Folder folder;
  for (const char* offset : {"[0.2, 0, 0]", "[0, 0.2, 0]", "[-0.1, 0.1, 0]", "[0.05, -0.05, 0.1]"}) {
    const std::string name = std::string("run") + offset;
    const Ended ended = run(folder, "rex_drive",
                            words({drive_along(folder, name),
                                   {"--processes", "one", "--set", "motion_capture.displaced=[2.5, 100]",
                                    "--set", std::string("motion_capture.offset=") + offset}}));
    ASSERT_EQ(ended.status, 0) << ended.all();
    const nlohmann::json told = summary(folder / name);
    EXPECT_GT(figure(told, "map_rejected"), 1) << offset;
    EXPECT_LE(figure(told, "return_kick_mps"), 0.1) << offset;
  }
}

TEST(RexDrive, ErrorsOfCamerasNameTheEyes) {
  const Folder folder(false);
  const Ended ended = run(folder, "rex_drive", {"--eyes", "off", "--set", "cameras.light.exposure=0.01"});
  EXPECT_EQ(ended.status, 2) << ended.all();
  EXPECT_NE(ended.all().find("its eyes are off"), std::string::npos) << ended.all();
}

TEST(RexDrive, DrivesOnWithoutTheMapForAWhile) {
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          words({drive_along(folder), {"--processes", "one", "--set", "motion_capture.lost=[2, 3]"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_EQ(told.at("outcome"), "done");
  EXPECT_LE(figure(told, "track_max_mm"), 100);
  for (const char* line :
       {"map lost: the platform goes on by its wheels and the IMU", "map seen again after 0.6 s"})
    EXPECT_NE(ended.all().find(line), std::string::npos) << line << "\n" << ended.all();
}

// Of the standard deviation where the platform stops, of the time where the task ends.
TEST(RexDrive, SaysWhichLimitAPositionThatIsLostHasPassed) {
  const Folder folder;
  const Ended ended = run(folder, "rex_drive",
                          words({drive_along(folder),
                                 {"--processes", "one", "--set", "motion_capture.lost=[2, 100]", "--set",
                                  "task.position_lost=0.01", "--set", "task.position_timeout=1"}}));
  ASSERT_EQ(ended.status, 1) << ended.all();
  for (const char* line : {"position lost: the platform waits for it, 1 s at most",
                           "value 1, limit 1, s of waiting for the position, task.position_timeout"})
    EXPECT_NE(ended.all().find(line), std::string::npos) << line << "\n" << ended.all();
  const std::string messages = bytes_of(folder / "run" / "messages.log");
  EXPECT_NE(messages.find("limit 0.01, m, standard deviation of the position"), std::string::npos)
      << messages;
}

TEST(RexDrive, SaysThatItGoesOnWhenItsPositionIsBack) {
  const Folder folder;
  const Ended ended = run(folder, "rex_drive",
                          words({drive_along(folder),
                                 {"--processes", "one", "--set", "motion_capture.lost=[2, 5]", "--set",
                                  "task.position_lost=0.01"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_NE(ended.all().find("position known again after"), std::string::npos) << ended.all();
}

TEST(RexDrive, DoesNotBelieveAMapWithOutliers) {
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          words({drive_along(folder), {"--processes", "one", "--set", "motion_capture.outliers=0.1"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_GT(figure(told, "map_rejected"), 0);
  EXPECT_LE(figure(told, "track_max_mm"), 60);
}

// On ice below the right wheels, a turn on the spot and a way back: left and right change sides.
TEST(RexDrive, KnowsWhereItIsWhenTheGroundChanges) {
  for (const char* seed : {"1", "2"}) {
    const Folder folder;
    const Ended ended = run(folder, "rex_drive",
                            {"--plan", "there_and_back", "--ground", "ice_right", "--processes", "one",
                             "--eyes", "off", "--seed", seed, "--run-dir", (folder / "run").string()});
    ASSERT_EQ(ended.status, 0) << ended.all();
    const nlohmann::json told = summary(folder / "run");
    EXPECT_EQ(figure(told, "map_rejected"), 0) << "all of its positions are good";
    EXPECT_LE(figure(told, "track_rms_mm"), 15);
    EXPECT_GE(figure(told, "ellipse_95_pct"), 75);
  }
}

TEST(RexDrive, StandsDuringAPauseAndComesToTheEndOfItsPlan) {
  const Folder folder;
  const std::string script = folder.write("orders", "3 start\n100 pause\n150 resume\n");
  const Ended ended =
      run(folder, "rex_drive", words({drive_along(folder), {"--processes", "one", "--script", script}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "track_max_mm"), 60);
}

TEST(RexDrive, TablesOfAStoppedRunReachToTheRestOfThePlatform) {
  const Folder folder(false);
  const Ended ended =
      run(folder, "rex_drive", words({drive_along(folder), {"--processes", "one", "--max-time", "2.5"}}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  const fs::path table = folder / "run" / "platform.csv";
  EXPECT_LT(std::abs(column_of(table, "vx").back()), 0.01);
  EXPECT_GT(std::ranges::max(column_of(table, "vx")), 0.3) << "it was on its way";
  EXPECT_NE(ended.all().find("steps until the platform was at rest"), std::string::npos) << ended.all();
}

TEST(RexDrive, FindsHalfTheFrictionInACurve) {
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          {"--processes", "one", "--eyes", "off", "--ground", "smooth", "--set",
           "sim.ground.patches.half.area=[-3, -2, 3, 2]", "--set", "sim.ground.patches.half.scale=0.5",
           "--set", "sim.ground.patches.half.from=7", "--run-dir", (folder / "run").string()});
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_LE(figure(told, "friction_found_s"), 1.5) << ended.all();
  EXPECT_LE(figure(told, "track_max_mm"), 20);
}

/// @return steps from an order to rest, on the way of `more`
double steps_to_rest(const std::string& order, int macrostep, const std::vector<std::string>& more) {
  const Folder folder(false);
  const std::string script =
      folder.write("orders", "3 start\n" + std::to_string(macrostep) + " " + order + "\n");
  const Ended ended = run(folder, "rex_drive",
                          words({{"--processes", "one", "--eyes", "off", "--script", script, "--run-dir",
                                  (folder / "run").string()},
                                 more}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  return figure(summary(folder / "run"), "stop_steps_max");
}

TEST(RexDrive, AnEmergencyStopIsAtRestBeforeAStopIs) {
  for (const int macrostep : {250, 320, 390}) {
    const double stopped = steps_to_rest("stop", macrostep, {}),
                 braked = steps_to_rest("e-stop", macrostep, {});
    EXPECT_GT(stopped, 100) << macrostep << ": it was on its way";
    EXPECT_LE(stopped, 300) << macrostep;
    EXPECT_GT(braked, 50) << macrostep;
    EXPECT_LE(braked, 130) << macrostep;
    EXPECT_LT(braked, stopped) << macrostep;
  }
}

// 1.3 m/s where curves allow it, on ground with half the friction: the fastest that a plan may be driven.
TEST(RexDrive, AStopAtSpeedOnSlipperyGroundIsBounded) {
  for (const int macrostep : {170, 230, 390})
    EXPECT_LE(steps_to_rest("stop", macrostep,
                            {"--ground", "slippery", "--speed-mps", "1.3", "--set", "task.lateral=1.7",
                             "--set", "task.turn_rate=2.1"}),
              380)
        << macrostep;
}

TEST(RexDrive, FiguresAreJudgedWhereTheyAreMeant) {
  const Folder folder;
  const auto told_of = [&](const char* name, const std::vector<std::string>& more) {
    return run(folder, "rex_drive", words({drive_along(folder, name), {"--processes", "one"}, more})).all();
  };
  const std::string slippery = told_of("slippery", {"--ground", "slippery"});
  EXPECT_NE(slippery.find("<= 15"), std::string::npos) << slippery;
  EXPECT_EQ(slippery.find("<= 40"), std::string::npos) << slippery;
  const std::string kinematic = told_of("kinematic", {"--tracker", "kinematic"});
  EXPECT_EQ(kinematic.find("<= 10"), std::string::npos) << kinematic;
}

TEST(RexDrive, ErrorsNameTheOptionThatWasTyped) {
  const Folder folder(false);
  const auto error_of = [&](const std::vector<std::string>& words) {
    const Ended ended = run(folder, "rex_drive", words);
    EXPECT_EQ(ended.status, 2) << ended.all();
    return ended.last_err();
  };
  EXPECT_NE(error_of({"--speed-mps", "9"}).find("--speed-mps 9: "), std::string::npos);
  EXPECT_NE(error_of({"--tracker", "guess"}).find("--tracker "), std::string::npos);
  EXPECT_NE(error_of({"--set", "task.speed=9"}).find("--set task.speed=9: "), std::string::npos);
  EXPECT_NE(error_of({"--plan", ""}).find("--plan: "), std::string::npos);
}

// Where it pushes: of a wheel that is blocked while little is asked of it the encoder may seem to stand (docs/rex.md).
TEST(RexDrive, ABlockedWheelEndsTheRunWithItsName) {
  const Folder folder(false);
  const Ended ended = run(folder, "rex_drive",
                          words({drive_along(folder),
                                 {"--processes", "one", "--set", "sim.platforms.rex.faults.wheel=2", "--set",
                                  "sim.platforms.rex.faults.wheel_blocked=[700, 100000]"}}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_NE(ended.all().find("wheel_blocked"), std::string::npos) << ended.all();
}

TEST(RexDrive, DrivesThoughEveryThirdCommandIsLost) {
  const Folder folder;
  const Ended ended = run(
      folder, "rex_drive",
      words({drive_along(folder), {"--processes", "one", "--set", "platforms.rex.command_link.loss=0.3"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "track_max_mm"), 60);
}

TEST(RexDrive, ASilenceOfTheControlSubsystemEndsTheRun) {
  const Folder folder(false);
  const Ended ended = run(folder, "rex_drive",
                          words({drive_along(folder),
                                 {"--processes", "one", "--set", "platforms.rex.command_link.loss=0.3",
                                  "--set", "platforms.rex.silence=3"}}));
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_NE(ended.last_err().find("peer_silent"), std::string::npos) << ended.all();
}

class RexDriveWithADeath : public ::testing::TestWithParam<const char*> {};

TEST_P(RexDriveWithADeath, EndsAndNamesTheProcess) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder(false);
  const std::string part = GetParam();
  Started task(folder, "rex_drive",
               words({see_along(folder), small_pictures(), {"--processes", "separate", "--speed", "1"}}));
  ASSERT_TRUE(task.await_line("plan 1 of 1")) << task.end().all();
  const std::vector<ProcessId> children = task.children();
  ::kill(task.child(part).pid, SIGKILL);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: process_died: ")) << ended.all();
  EXPECT_NE(ended.last_err().find(part), std::string::npos) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

INSTANTIATE_TEST_SUITE_P(Of, RexDriveWithADeath,
                         ::testing::Values("simulator", "edp-rex", "ecp-rex", "ecp-map", "vsp-odometry-rex"),
                         [](const auto& named) {
                           std::string name = named.param;
                           std::erase(name, '-');
                           return name;
                         });

// Nobody drives it any more, and simulated time runs as fast as it can: the drives brake, and somebody must tell the rest.
TEST(RexDrive, ADriverThatDiesAtFullSpeedLeavesThePlatformAtRest) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder(false);
  for (const int wait : {0, 100, 200}) {
    const std::string name = "run" + std::to_string(wait);
    Started task(folder, "rex_drive",
                 {"--speed-mps", "0.8", "--eyes", "off", "--processes", "separate", "--run-dir",
                  (folder / name).string()},
                 name);
    ASSERT_TRUE(task.await_line("plan 1 of 2")) << task.end().all();
    std::this_thread::sleep_for(std::chrono::milliseconds(wait));
    ::kill(task.child("edp-rex").pid, SIGKILL);
    const Ended ended = task.end();
    EXPECT_EQ(ended.status, 3) << ended.all();
    EXPECT_EQ(ended.all().find("stop_not_confirmed"), std::string::npos) << ended.all();
    EXPECT_LE(figure(summary(folder / name), "stop_steps_max"), 300) << ended.all();
  }
}

struct Refused {
  const char* name;
  const char* plan;
  const char* told;
};

TEST(RexDrive, RefusesWhatCannotBeDrivenBeforeAnythingStarts) {
  const Folder folder(false);
  const std::array cases{Refused{"empty", "", "plan"},
                         Refused{"word", "0 0\n1 north\n", ":2"},
                         Refused{"infinite", "0 0\ninf 0\n", ":2"},
                         Refused{"outside", "0 0\n1 0\n9 0\n", "room"},
                         Refused{"huge", "0 0\n1e9 0\n", ":2"},
                         Refused{"one", "1 1\n", "one point"}};
  for (const Refused& k : cases) {
    const std::string plan = folder.write(k.name, k.plan);
    const fs::path run_folder = folder / (std::string("run_") + k.name);
    const Ended ended = run(folder, "rex_drive", {"--plan", plan, "--run-dir", run_folder.string()});
    EXPECT_EQ(ended.status, 2) << k.name << ended.all();
    EXPECT_NE(ended.last_err().find(k.told), std::string::npos) << k.name << ended.all();
    EXPECT_FALSE(fs::exists(run_folder)) << k.name;
  }
}

}  // namespace
}  // namespace mrroc::test
