// Tasks can be recomputed from the logs of their runs, as the figure log_check_differences says: all but manual and rubik, whose
// runs are in manual_test.cpp and rubik_test.cpp, and are recomputed there.
#include <gtest/gtest.h>

#include <fstream>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

class Checked : public ::testing::Test {
 protected:
  void SetUp() override {
    if (kSanitized) GTEST_SKIP() << "too long";
  }

  /// Runs a task, which must end well unless a status is named. @return its run folder
  fs::path ran(const std::string& task, const std::vector<std::string>& more = {}, int status = 0) {
    fs::path run_folder = folder_ / (task + std::to_string(++runs_));
    const Ended ended =
        run(folder_, task, words({{"--processes", "one", "--run-dir", run_folder.string()}, more}));
    EXPECT_EQ(ended.status, status) << task << ": " << ended.all();
    return run_folder;
  }

  nlohmann::json check(const fs::path& run_folder, int status = 0) {
    const Ended ended = run(folder_, "ui_cli", {"log", "check", run_folder.string(), "--json"});
    EXPECT_EQ(ended.status, status) << ended.all();
    std::string text;
    for (const std::string& line : ended.out) text += line + "\n";
    return nlohmann::json::parse(text, nullptr, false);
  }

  static nlohmann::json process(const nlohmann::json& checked, const std::string& name) {
    for (const auto& p : checked.at("processes"))
      if (p.at("process") == name) return p;
    throw std::out_of_range("log check tells nothing of " + name);
  }

  /// Every process of the control system that messages can drive has been recomputed, and nothing differs.
  static void expect_same(const nlohmann::json& checked, const std::vector<std::string>& names) {
    EXPECT_EQ(checked.at("differences"), 0) << checked.dump(2);
    EXPECT_EQ(checked.at("complete"), true) << checked.dump(2);
    for (const std::string& name : names) {
      const auto p = process(checked, name);
      EXPECT_EQ(p.at("not_checked"), "") << name;
      EXPECT_GT(p.at("compared").get<int>(), 300) << name;
    }
  }

  Folder folder_{false};  // they are recomputed one by one, and some logs are damaged
  int runs_{};
};

// Simulator and drivers go on until all rest, for some servo steps more or less.
TEST_F(Checked, ARunThatAStopHasEndedHasAWholeLog) {
  const fs::path orders = folder_.write("orders", "3 start\n60 stop\n");
  const auto checked = check(ran("press", {"--script", orders.string()}, 1));
  EXPECT_EQ(checked.at("complete"), true) << checked.dump(2);
  EXPECT_EQ(checked.at("differences"), 0) << checked.dump(2);
}

TEST_F(Checked, PressIsRecomputedFromItsLog) {
  const auto checked = check(ran("press"));
  expect_same(checked, {"mp", "ecp-arm1"});
  EXPECT_NE(process(checked, "simulator").at("not_checked"), "") << "its links are not in the log";
  EXPECT_NE(process(checked, "edp-arm1").at("not_checked"), "");
}

TEST_F(Checked, APausedAndAStoppedRunAreRecomputedToo) {
  const std::string pause = folder_.write("pause", "3 start\n120 pause\n160 resume\n");
  expect_same(check(ran("press", {"--script", pause})), {"mp", "ecp-arm1"});
  const std::string stop = folder_.write("stop", "3 start\n170 stop\n");
  const auto stopped = check(ran("press", {"--script", stop}, 1));
  EXPECT_EQ(stopped.at("differences"), 0);
  EXPECT_EQ(stopped.at("complete"), true) << stopped.dump(2);
}

TEST_F(Checked, WeighIsRecomputedFromItsLog) { expect_same(check(ran("weigh")), {"mp", "ecp-arm1"}); }

TEST_F(Checked, EdgeFollowIsRecomputedFromItsLog) {
  expect_same(check(ran("edge_follow")), {"mp", "ecp-arm1", "ecp-arm2"});
}

TEST_F(Checked, DrawingIsRecomputedFromItsLogTaughtOrLoaded) {
  const std::vector<std::string> all{"mp", "ecp-arm1", "ecp-arm2", "vsp-arm1", "vsp-arm2"};
  const std::string lines = folder_.write("lines.svg", lines_svg(1));
  const std::string taught = (folder_ / "lines.recording").string();
  expect_same(check(ran("drawing", {"--drawing", lines, "--size", "17", "--save", taught})), all);
  expect_same(check(ran("drawing", {"--load", taught})), all);
}

TEST_F(Checked, VisualServoIsRecomputedFromItsLog) {
  const auto checked =
      check(ran("visual_servo", {"--object", "apriltag", "--cameras", "sac", "--set", "task.duration=3"}));
  expect_same(checked, {"mp", "ecp-arm1"});
  EXPECT_NE(process(checked, "vsp-sac").at("not_checked"), "") << "pictures are not in the log";
}

TEST_F(Checked, AChangedByteIsNamedWithProcessStepBehaviourFunctionAndField) {
  const fs::path run_folder = ran("press");
  const fs::path log = run_folder / "events.lcmlog";
  std::string bytes;
  {
    std::ifstream in(log, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  // The 200th command of the log: the velocity along z in its task frame.
  std::size_t channel = 0;
  for (int k = 0; k < 200; ++k) channel = bytes.find(".arm1.command", channel + 1);
  ASSERT_NE(channel, std::string::npos);
  const std::size_t message = channel + std::string(".arm1.command").size();
  const std::size_t velocity = message + 8 + 24 + 16 + 6 + 8 + 3 + 16 * 8 + 2 * 33 + 1 + 8;
  bytes[velocity + 2] = static_cast<char>(bytes[velocity + 2] ^ 0x10);
  std::ofstream(log, std::ios::binary | std::ios::trunc) << bytes;
  const auto checked = check(run_folder, 1);
  EXPECT_EQ(checked.at("differences"), 1);
  const auto first = process(checked, "ecp-arm1").at("first");
  EXPECT_EQ(first.at("channel"), "arm1.command");
  EXPECT_EQ(first.at("field"), "arm.axis[2].velocity");
  EXPECT_EQ(first.at("function"), "f_ce");
  EXPECT_EQ(first.at("stamp"), 200);
  EXPECT_EQ(first.at("behaviour"), "2, settle");
}

TEST_F(Checked, ALogThatIsCutOffIsNotWhole) {
  const fs::path run_folder = ran("press");
  EXPECT_TRUE(check(run_folder, 0).at("damage").get<std::string>().empty());
  const fs::path log = run_folder / "events.lcmlog";
  fs::resize_file(log, fs::file_size(log) * 2 / 3);
  const auto checked = check(run_folder, 1);
  EXPECT_FALSE(checked.at("complete").get<bool>());
  EXPECT_NE(checked.at("damage").get<std::string>().find("cut off"), std::string::npos)
      << checked.at("damage");
}

TEST_F(Checked, ProgramsAreFoundBesideTheProgramOrBesideItsLinkAndMissedByName) {
  const fs::path recorded = ran("press");
  const fs::path link = folder_ / "link", lonely = folder_ / "lonely", project = folder_ / "project";
  fs::create_symlink(started_program("ui_cli"), link);
  EXPECT_EQ(run(folder_, link.string(), {"log", "check", recorded.string()}).status, 0);
  fs::create_directory(lonely);
  fs::copy_file(started_program("ui_cli"), lonely / "ui_cli");
  for (const auto& line : {std::vector<std::string>{"log", "check", recorded.string()},
                           std::vector<std::string>{"replay", recorded.string(), "--with", "ecp-arm1"}}) {
    const Ended alone = run(folder_, (lonely / "ui_cli").string(), line);
    EXPECT_EQ(alone.status, 3) << alone.all();
    EXPECT_NE(alone.last_err().find("in " + lonely.string() + ", beside ui_cli"), std::string::npos)
        << alone.all();
  }
  fs::create_directory(
      project);  // as one outside of the tree: its own programs, and a link to the installed ui_cli
  fs::create_symlink(lonely / "ui_cli", project / "ui_cli");
  for (const char* program : {"press", "ecp_press", "edp_irb6", "simulator"})
    fs::create_symlink(started_program(program), project / program);
  const Ended linked = run(folder_, (project / "ui_cli").string(), {"log", "check", recorded.string()});
  EXPECT_EQ(linked.status, 0) << linked.all();
}

TEST_F(Checked, AChangedParameterChangesWhatIsRecomputed) {
  const fs::path run_folder = ran("edge_follow");
  std::ifstream in(run_folder / "config.toml");
  std::string config(std::istreambuf_iterator<char>(in), {});
  const std::size_t key = config.find("speed_per_force = ");
  ASSERT_NE(key, std::string::npos);
  config.insert(key + std::string("speed_per_force = ").size(), "0.0015 # ");
  std::ofstream(run_folder / "config.toml") << config;
  const auto checked = check(run_folder, 1);
  const auto first = process(checked, "ecp-arm1").at("first");
  EXPECT_EQ(first.at("channel"), "arm1.command");
  EXPECT_NE(first.at("behaviour"), "");
}

}  // namespace
}  // namespace mrroc::test
