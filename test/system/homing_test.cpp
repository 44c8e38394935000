// Every task with arms that are homed first: it begins where it begins with a known pose.
#include <gtest/gtest.h>

#include <algorithm>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// A task, made as short as it can be.
struct HomedRun {
  std::string task;
  int arms{1};
  std::vector<std::string> arguments;  ///< FILE: name of the file
  std::string file;                    ///< its content; empty: there is none
};
void PrintTo(const HomedRun& k, std::ostream* out) { *out << k.task; }  // NOLINT: the name that gtest wants

const std::vector<HomedRun> kRuns{
    {"press", 1, {}, ""},
    {"weigh", 1, {}, ""},
    {"edge_follow", 2, {}, ""},
    {"move", 2, {}, ""},
    {"drawing", 2, {"--drawing", "FILE", "--size", "10"}, lines_svg(1)},
    {"manual",
     2,
     {"--words", "FILE"},
     "3 home all\n7500 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57 speed 0.5 acceleration 0.2\n7800 end\n"},
    // A picture in 0.2 s: while the arms are homed nobody looks at them.
    {"visual_servo",
     1,
     {"--object", "apriltag", "--cameras", "sac", "--set", "cameras.profile=fast", "--set",
      "cameras.sac.period=100", "--set", "task.max_age=1", "--set", "task.duration=2"},
     ""},
};

class EveryTaskAfterHoming : public ::testing::TestWithParam<HomedRun> {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }
  /// @param kinematics  of all arms, true ones too
  void comes_to_its_end(const std::string& kinematics, int seed) {
    const HomedRun& k = GetParam();
    const Folder folder(false);
    std::vector<std::string> arguments =
        words({{"--processes", "one", "--seed", std::to_string(seed), "--run-dir", (folder / "run").string()},
               k.arguments});
    if (!k.file.empty()) std::ranges::replace(arguments, "FILE", folder.write("file", k.file));
    const std::vector<std::string> settings{"synchro=homing", "kinematics=" + kinematics};
    for (int arm = 1; arm <= k.arms; ++arm)
      for (const std::string& setting : settings)
        arguments.insert(arguments.end(), {"--set", "robots.arm" + std::to_string(arm) + "." + setting});
    const Ended ended = run(folder, k.task, arguments);
    EXPECT_EQ(ended.status, 0) << ended.all();
  }
};

TEST_P(EveryTaskAfterHoming, ComesToItsEnd) {
  for (const int seed : {1, 2}) comes_to_its_end("nominal", seed);
}

TEST_P(EveryTaskAfterHoming, ComesToItsEndWithTheCalibratedKinematics) { comes_to_its_end("calibrated", 3); }

INSTANTIATE_TEST_SUITE_P(Of, EveryTaskAfterHoming, ::testing::ValuesIn(kRuns),
                         [](const auto& named) { return named.param.task; });

TEST(RubikAfterHoming, IsRefusedBeforeAnythingMovesSinceTheHandWouldMeetWhatStandsAroundIt) {
  const Folder folder(false);
  const Ended ended =
      run(folder, "rubik",
          {"--eyes", "none", "--set", "task.tables=small", "--set", "robots.arm2.synchro=homing"});
  EXPECT_EQ(ended.status, 2) << ended.all();
  EXPECT_NE(ended.last_err().find("robots.arm2.synchro"), std::string::npos) << ended.all();
}

TEST(PressAfterHoming, FindsItsTableAsWithAKnownPose) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const auto press = [&](const std::string& synchro) {
    const Ended ended = run(folder, "press",
                            {"--processes", "one", "--run-dir", (folder / synchro).string(), "--set",
                             "robots.arm1.synchro=" + synchro});
    EXPECT_EQ(ended.status, 0) << ended.all();
    return summary(folder / synchro);
  };
  const auto known = press("known_pose"), homed = press("homing");
  for (const char* const key : {"approach_settled_N", "hold_N"})
    EXPECT_NEAR(figure(homed, key), figure(known, key), 0.05) << key;
}

}  // namespace
}  // namespace mrroc::test
