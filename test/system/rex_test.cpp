// The platform's task as a user starts it: plans, a map that is lost, processes that die, plans that are refused.
#include <gtest/gtest.h>
#include <csignal>

#include <array>
#include <fstream>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

/// Two legs with a corner between them.
constexpr const char* kTwoLegs = "0 0\n0.7 0\n1.2 0.3\n1.4 0.9\n";

std::vector<std::string> drive_along(const Folder& folder, const std::string& name = "run") {
  return {"--plan", folder.write("plan.txt", kTwoLegs), "--run-dir", (folder / name).string()};
}

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
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

TEST(RexDrive, DrivesOnWithoutTheMapForAWhile) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          words({drive_along(folder), {"--processes", "one", "--set", "motion_capture.lost=[3, 5]"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_EQ(told.at("outcome"), "done");
  EXPECT_LE(figure(told, "track_max_mm"), 100);
}

TEST(RexDrive, DoesNotBelieveAMapWithOutliers) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const Ended ended =
      run(folder, "rex_drive",
          words({drive_along(folder), {"--processes", "one", "--set", "motion_capture.outliers=0.1"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const nlohmann::json told = summary(folder / "run");
  EXPECT_GT(figure(told, "map_rejected"), 0);
  EXPECT_LE(figure(told, "track_max_mm"), 60);
}

TEST(RexDrive, StandsDuringAPauseAndComesToTheEndOfItsPlan) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const std::string script = folder.write("orders", "3 start\n150 pause\n300 resume\n");
  const Ended ended =
      run(folder, "rex_drive", words({drive_along(folder), {"--processes", "one", "--script", script}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "track_max_mm"), 60);
}

TEST(RexDrive, ABlockedWheelEndsTheRunWithItsName) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder(false);
  const Ended ended = run(folder, "rex_drive",
                          words({drive_along(folder),
                                 {"--processes", "one", "--set", "sim.platforms.rex.faults.wheel=2", "--set",
                                  "sim.platforms.rex.faults.wheel_blocked=[1500, 100000]"}}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_NE(ended.all().find("wheel_blocked"), std::string::npos) << ended.all();
}

TEST(RexDrive, DrivesThoughEveryThirdCommandIsLost) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const Ended ended = run(
      folder, "rex_drive",
      words({drive_along(folder), {"--processes", "one", "--set", "platforms.rex.command_link.loss=0.3"}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "track_max_mm"), 60);
}

TEST(RexDrive, ASilenceOfTheControlSubsystemEndsTheRun) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder(false);
  const Ended ended = run(folder, "rex_drive",
                          {"--plan", "square", "--run-dir", (folder / "run").string(), "--processes", "one",
                           "--set", "platforms.rex.command_link.loss=0.5", "--max-time", "60"});
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_NE(ended.last_err().find("peer_silent"), std::string::npos) << ended.all();
}

class RexDriveWithADeath : public ::testing::TestWithParam<const char*> {};

TEST_P(RexDriveWithADeath, EndsAndNamesTheProcess) {
  if (kSanitized || !multicast()) GTEST_SKIP() << "no multicast, or too slow";
  const Folder folder(false);
  const std::string part = GetParam();
  Started task(folder, "rex_drive",
               words({drive_along(folder), {"--processes", "separate", "--speed", "2"}}));
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
                         ::testing::Values("simulator", "edp-rex", "ecp-rex", "ecp-map"),
                         [](const auto& named) {
                           std::string name = named.param;
                           std::erase(name, '-');
                           return name;
                         });

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
