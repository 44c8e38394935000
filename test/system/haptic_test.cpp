// The task haptic as a user starts it: what it must reach in the air and in contact, over good and bad channels, that it refuses in
// time, and that it obeys.
#include <gtest/gtest.h>

#include <csignal>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// A run that has come to its end. @return its summary
nlohmann::json coupled(const Folder& folder, const std::vector<std::string>& arguments) {
  const std::string run_folder = (folder / "run").string();
  const Ended ended =
      run(folder, "haptic", words({{"--processes", "one", "--run-dir", run_folder}, arguments}));
  EXPECT_EQ(ended.status, 0) << ended.all();
  auto s = summary(run_folder);
  EXPECT_EQ(s.at("outcome"), "done");
  return s;
}

TEST(HapticTask, FollowsInTheAirAndLetsTheHandFeelTheWallAndThePlate) {
  const Folder folder;
  const auto s = coupled(folder, {});
  EXPECT_LE(figure(s, "follow_lag_macrosteps"), 4);
  EXPECT_LE(figure(s, "follow_rms_mm"), 1);
  EXPECT_LE(figure(s, "reflect_err_pct"), 5);
  EXPECT_GT(figure(s, "exerted_force_N"), 9) << "the hand pushes";
  EXPECT_GE(figure(s, "energy_min_mJ"), -1);
  EXPECT_TRUE(std::filesystem::exists(folder / "run" / "haptic.csv"));
}

TEST(HapticTask, ScalesMotionAndForce) {
  const Folder folder;
  const auto s = coupled(folder, {"--set", "task.motion_scale=1.5", "--set", "task.force_scale=0.5"});
  EXPECT_LE(figure(s, "follow_rms_mm"), 1);
  EXPECT_LE(figure(s, "reflect_err_pct"), 5);
  EXPECT_GT(figure(s, "exerted_force_N"), 1.5 * 9) << "the hand pushes with half of what the slave exerts";
}

TEST(HapticTask, StaysPassiveOverTheWorstChannelOnTheStiffestWall) {
  const Folder folder;
  const auto s =
      coupled(folder, {"--delay", "200", "--jitter", "20", "--loss", "10", "--set", "table.stiffness=50000"});
  EXPECT_GE(figure(s, "energy_min_mJ"), -1);
  EXPECT_GT(figure(s, "exerted_force_N"), 3) << "the slave meets the plate";
  EXPECT_LE(figure(s, "exerted_force_N"), 45) << "and does not swing on it";
  EXPECT_GT(figure(s, "kept_back_mJ"), 1);
}

TEST(HapticTask, IsRepeatedBitForBitAndOverAnotherChannelWithAnotherSeed) {
  const Folder folder;
  const std::vector<std::string> channel{"--delay", "40", "--jitter", "20", "--loss", "10"};
  const auto hash = [&](const std::vector<std::string>& more) {
    std::filesystem::remove_all(folder / "run");
    return coupled(folder, words({channel, more})).at("log_hash");
  };
  const auto first = hash({});
  EXPECT_EQ(hash({}), first);
  EXPECT_NE(hash({"--seed", "2"}), first);
}

TEST(HapticTask, RefusesWhatCannotWorkBeforeAnythingMoves) {
  const Folder folder;
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& why) {
    const Ended ended = run(
        folder, "haptic", words({{"--processes", "one", "--run-dir", (folder / "run").string()}, arguments}));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find(why), std::string::npos) << ended.all();
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  };
  refused({"--delay", "201"}, "201");  // [ms], as it was typed
  refused({"--delay", "300"}, "200");
  refused({"--delay", "100", "--set", "task.delay=0.05"}, "--delay and --set task.delay");
  refused({"--loss", "90"}, "--loss");
  refused({"--set", "task.motion_scale=0"}, "motion_scale");
  refused({"--set", "robots.arm2.plate.shape=none"}, "plate");
  refused({"--set", "table.stiffness=500000"}, "swing");
  refused({"--set", "task.passivity=false", "--delay", "100"}, "passivity");
  refused({"--set", "task.motion_scale=0.5", "--set", "robots.arm2.plate.thickness=0.03"}, "table");
  refused({"--set", "robots.arm2.plate.distance=0.2"}, "the hand leads arm1 by");
}

TEST(HapticTask, StopsInContactAsEveryTaskDoes) {
  const Folder folder;
  const std::string orders = folder.write("orders", "3 start\n3600 stop\n");
  const std::string run_folder = (folder / "run").string();
  const Ended ended =
      run(folder, "haptic",
          {"--processes", "one", "--run-dir", run_folder, "--delay", "100", "--script", orders});
  EXPECT_EQ(ended.status, 1) << ended.all();
  const auto s = summary(run_folder);
  EXPECT_EQ(s.at("outcome"), "stopped");
  EXPECT_LE(s.at("figures").at("stop_steps_max").get<double>(), 100);
}

TEST(HapticTask, GoesOnAfterAPause) {
  const Folder folder;
  const std::string orders =
      folder.write("orders", "3 start\n1500 pause\n2500 resume\n11000 trigger\n12500 trigger\n");
  const auto s = coupled(folder, {"--script", orders});
  EXPECT_LE(figure(s, "reflect_err_pct"), 5);
  EXPECT_GE(figure(s, "energy_min_mJ"), -1);
}

TEST(HapticTask, BrakesBothArmsWhenAControlSubsystemDies) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder(false);
  Started haptic(folder, "haptic", {"--speed", "4", "--run-dir", (folder / "run").string()});
  ASSERT_TRUE(haptic.await_line("coupled"));
  const auto children = haptic.children();
  ::kill(haptic.child("ecp-arm2").pid, SIGKILL);
  const Ended ended = haptic.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

}  // namespace
}  // namespace mrroc::test
