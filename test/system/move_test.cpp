// The task `move`: every generator, two arms together, what is refused, stop and emergency stop, teach-in.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <set>

#include "base/link/log_reader.hpp"
#include "base/msg/convert.hpp"
#include "mp/arm_trace.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

std::string example(const std::string& name) { return std::string(MRROC_SOURCE_DIR) + "/tasks/move/" + name; }

class Move : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }
  Ended move(const std::string& file, const std::vector<std::string>& more = {}) {
    return run(
        folder_, "move",
        words({{"--processes", "one", "--run-dir", (folder_ / "run").string(), "--file", file}, more}));
  }
  static void expect_goals_reached(const nlohmann::json& s, std::size_t arms) {
    EXPECT_EQ(s.at("outcome"), "done");
    const auto& f = s.at("figures");
    for (const char* key : {"goal_error_mm", "speed_pct", "acceleration_pct"})
      ASSERT_EQ(f.at(key).size(), arms) << key;
    for (std::size_t arm = 0; arm < arms; ++arm) {
      EXPECT_LE(f.at("goal_error_mm").at(arm).get<double>(), 0.1);
      EXPECT_LE(f.at("goal_error_deg").at(arm).get<double>(), 0.05);
      EXPECT_LE(f.at("path_error_mm").at(arm).get<double>(), 5);
      EXPECT_LE(f.at("speed_pct").at(arm).get<double>(), 100);
      EXPECT_LE(f.at("acceleration_pct").at(arm).get<double>(), 100);
    }
  }

  Folder folder_;
};

TEST_F(Move, ExecutesEveryGeneratorInEveryRepresentation) {
  const Ended ended = move(example("all_generators.toml"));
  ASSERT_EQ(ended.status, 0) << ended.all();
  expect_goals_reached(summary(folder_ / "run"), 2);
  std::set<Representation> spaces;
  std::set<Interpolation> interpolations;
  std::set<Reference> references;
  for (const auto& [i, m] : link::LogReader(folder_ / "run").messages<effector_command_t>("arm1.command")) {
    const EffectorCommand c = from_message(m);
    if (!has(c.set, Part::arm)) continue;
    spaces.insert(c.arm.representation);
    interpolations.insert(c.arm.mu);
    references.insert(c.arm.reference);
  }
  EXPECT_EQ(spaces.size(), 5U);
  EXPECT_TRUE(interpolations.contains(Interpolation::mim) &&
              interpolations.contains(Interpolation::tcim_pose));
  EXPECT_EQ(references.size(), 2U);
}

TEST_F(Move, TwoArmsBeginAndEndTheirMotionsTogether) {
  const Ended ended = move(example("two_arms.toml"));
  ASSERT_EQ(ended.status, 0) << ended.all();
  expect_goals_reached(summary(folder_ / "run"), 2);
  const auto moving = [&](const char* arm) {
    std::vector<std::int64_t> macrosteps;
    for (const mp::ArmRow& r : mp::read_arm_trace(folder_ / "run" / arm))
      if (r.m == 4) macrosteps.push_back(r.i);
    return macrosteps;
  };
  EXPECT_FALSE(moving("arm1.csv").empty());
  EXPECT_EQ(moving("arm1.csv"), moving("arm2.csv"));
}

TEST_F(Move, IsTheSameAgainFromTheConfigurationOfItsRun) {
  ASSERT_EQ(move(example("two_arms.toml")).status, 0);
  const Ended again = run(folder_, "move",
                          {"--processes", "one", "--config", (folder_ / "run" / "config.toml").string(),
                           "--run-dir", (folder_ / "again").string()});
  ASSERT_EQ(again.status, 0) << again.all();
  EXPECT_EQ(summary(folder_ / "run")["log_hash"], summary(folder_ / "again")["log_hash"]);
}

TEST_F(Move, BadFilesAreRefusedBeforeAnythingStarts) {
  const auto refused = [&](const std::string& text, const std::string& words) {
    const Ended ended = move(folder_.write("bad.toml", text));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find(words), std::string::npos) << ended.all();
    EXPECT_FALSE(fs::exists(folder_ / "run"));
  };
  const std::string head = "[arm1]\norder = [\"a\"]\n[arm1.a]\n";
  refused(head + "positions = [0, 0, 0]\n", "bad.toml:4: 'arm1.a.positions' has 3 numbers");
  refused(head + "positions = [0, 0, 0, 0, 0, 0]\n", "joint_limit: arm1.a");
  refused(head + "space = \"xyz_angle_axis\"\npositions = [5, 0, 0, 0, 0, 0]\n", "unreachable_pose: arm1.a");
  refused(head + "generator = \"cubic\"\ntimes = [0.1]\npositions = [1, -1.57, 0, 1.56, 1.57, -1.57]\n",
          "too_fast: arm1.a");
  refused(head + "positions = [", "bad.toml:");
  EXPECT_EQ(move("/no/such/file").status, 2);
}

TEST_F(Move, OnlyChecksWhenAskedTo) {
  const Ended ended = move(example("all_generators.toml"), {"--dry-run"});
  EXPECT_EQ(ended.status, 0) << ended.all();
  EXPECT_EQ(ended.last_out(), "within all limits");
  EXPECT_FALSE(fs::exists(folder_ / "run"));
}

TEST_F(Move, StandsDuringAPauseAndReachesItsGoals) {
  const Ended ended =
      move(example("two_arms.toml"),
           {"--script", folder_.write("orders", "3 start\n200 pause\n300 resume\n"), "--speed", "50"});
  ASSERT_EQ(ended.status, 0) << ended.all();
  expect_goals_reached(summary(folder_ / "run"), 2);
}

TEST_F(Move, EndsByStopAndByEmergencyStop) {
  for (const std::string order : {"stop", "e-stop"}) {
    const Ended ended = run(folder_, "move",
                            {"--processes", "one", "--run-dir", (folder_ / order).string(), "--script",
                             folder_.write("orders", "3 start\n200 " + order + "\n")});
    EXPECT_EQ(ended.status, 1) << ended.all();
    EXPECT_EQ(summary(folder_ / order).at("outcome"), "stopped");
  }
}

TEST_F(Move, ADriverThatIsKilledEndsTheRun) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  Started task(folder_, "move", {"--speed", "1", "--run-dir", (folder_ / "run").string()});
  ASSERT_TRUE(task.await_line("go to the start"));
  const auto children = task.children();
  ::kill(task.child("edp-arm1").pid, SIGKILL);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(all_gone(children));
}

TEST_F(Move, GoesThroughPositionsThatWereTaughtByHand) {
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const std::string file = (folder_ / "taught.toml").string();
  {
    Started manual(folder_, "manual",
                   {"--speed", "10", "--run-dir", (folder_ / "manual").string(), "--set",
                    "robots.arm1.synchro=\"known_pose\"", "--set", "robots.arm2.synchro=\"known_pose\""});
    const auto tell = [&](const std::vector<std::string>& instruction) {
      const Ended e = run(folder_, "ui_cli", words({{"manual"}, instruction}));
      EXPECT_EQ(e.status, 0) << e.all();
    };
    ASSERT_TRUE(manual.await_line("wait for an order"));
    tell({"home", "arm1"});
    for (const char* q1 : {"0", "0.1", "0.2"}) {
      tell({"move", "arm1", "joints", q1, "-1.5", "0", "1.5", "1.57", "-1.57", "speed", "0.5", "acceleration",
            "0.2"});
      tell({"teach", "arm1", file, "euler"});
    }
    tell({"end"});
    EXPECT_EQ(manual.end().status, 0);
  }
  const Ended ended = move(file);
  ASSERT_EQ(ended.status, 0) << ended.all();
  expect_goals_reached(summary(folder_ / "run"), 1);
  const mp::ArmTrace trace = mp::read_arm_trace(folder_ / "run" / "arm1.csv");
  const Vector6 last = trace.back().pose;
  EXPECT_NEAR(std::atan2(last[1], last[0]), 0.2, 2e-3) << "the column has turned";
}

}  // namespace
}  // namespace mrroc::test
