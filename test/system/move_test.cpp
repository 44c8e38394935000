// The task `move`: every generator, two arms together, what is refused, stop and emergency stop, teach-in.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <set>

#include "base/agent_images.hpp"
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

class Recorded : public Move {
 protected:
  /// Moves an arm in the task manual, which stands before and behind.
  void SetUp() override {
    Move::SetUp();
    if (IsSkipped()) return;
    const std::string instructions =
        folder_.write("words",
                      "3 home all\n"
                      "100 move arm1 joints 0.1 -1.5 0 1.5 1.57 -1.57 speed 0.5 acceleration 0.2\n"
                      "400 jog arm1 angle-axis 0 0 -0.05 0 0 0.1 speed 0.1 acceleration 0.02\n"
                      "600 jog arm1 joints 0.2 0 0 0 0 0 speed 0.3 acceleration 0.2\n"
                      "750 end\n");
    const Ended ended =
        run(folder_, "manual",
            {"--processes", "one", "--words", instructions, "--run-dir", (folder_ / "hand").string(), "--set",
             "robots.arm1.synchro=\"known_pose\"", "--set", "robots.arm2.synchro=\"known_pose\""});
    ASSERT_EQ(ended.status, 0) << ended.all();
  }
  std::string motion(const std::string& keys) {
    return folder_.write("again.toml",
                         "[arm1]\norder = [\"again\"]\n[arm1.again]\ngenerator = \"replay\"\n" + keys);
  }
  Vector6 last_pose(const std::string& run_folder) {
    return mp::read_arm_trace(folder_ / run_folder / "arm1.csv").back().pose;
  }
};

TEST_F(Recorded, MotionsOfARunAreRepeatedAndSoAreTheFilesThatItLeaves) {
  const EffectorReply there = from_message(
      std::prev(link::LogReader(folder_ / "hand").messages<effector_reply_t>("arm1.reply").end())->second);
  const Ended ended = move(motion("recording = \"hand\"\nfrom = 2\n"));
  ASSERT_EQ(ended.status, 0) << ended.all();
  expect_goals_reached(summary(folder_ / "run"), 1);
  EXPECT_LT((last_pose("run").head<3>() - pose_of(there).p).norm(), 1e-4);
  const auto first = summary(folder_ / "run")["log_hash"];
  fs::rename(folder_ / "run", folder_ / "first");

  const Ended again = move(motion("recording = \"first/arm1.again.taught\"\n"));
  ASSERT_EQ(again.status, 0) << again.all();
  EXPECT_EQ(summary(folder_ / "run")["log_hash"], first) << "17 digits are every bit";
}

TEST_F(Recorded, AreTakenInAnySpaceAbsoluteOrRelativeAsSlowlyAsAsked) {
  for (const std::string keys :
       {"space = \"motors\"\n", "space = \"xyz_angle_axis\"\ninterpolation = \"tcim\"\n",
        "space = \"xyz_euler_zyz\"\nstretch = 2\n", "space = \"joints\"\nreference = \"relative\"\n",
        R"(space = "xyz_angle_axis"
reference = "relative"
interpolation = "tcim"
contact = ["z"]
)"}) {
    const Ended ended = move(motion("recording = \"hand\"\nfrom = 7.5\nto = 11.9\n" + keys), {"--dry-run"});
    EXPECT_EQ(ended.status, 0) << keys << ended.all();
  }
}

TEST_F(Recorded, WhatCannotBeRepeatedIsRefusedWithFileLineAndKey) {
  const auto refused = [&](const std::string& keys, const std::string& words) {
    const Ended ended = move(motion(keys));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.last_err().find("again.toml:"), std::string::npos) << ended.all();
    EXPECT_NE(ended.last_err().find(words), std::string::npos) << ended.all();
    EXPECT_FALSE(fs::exists(folder_ / "run"));
  };
  folder_.write("cut.taught", "mrroc-trajectory 1\nspace joints\n");
  refused("recording = \"nothing\"\n", "no such file");
  refused("recording = \"cut.taught\"\n", "cut.taught");
  refused("recording = \"hand\"\npositions = [0, 0, 0, 0, 0, 0]\n",
          "'arm1.again.positions' must not stand here");
  refused("recording = \"hand\"\nspace = \"frame\"\n", "must be motors or joints");
  refused("recording = \"hand\"\nfrom = 14\nto = 14.01\n", "positions of arm1, and a motion has 2 to 2000");
  refused("recording = \"hand\"\nfrom = 3\nto = 2\n", "arm1.again.to");
  const Ended midway = move(motion("recording = \"hand\"\nfrom = 3\n"));
  EXPECT_NE(midway.last_err().find("too_fast: arm1.again, 0.00 s"), std::string::npos) << midway.all();
}

}  // namespace
}  // namespace mrroc::test
