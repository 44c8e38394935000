// Running a declared task: order of the steps before the start, and exit status.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "launch/task.hpp"

namespace mrroc::launch {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kConfig = R"(
[task]
force = 4
[robots]
order = ["arm1"]
[robots.arm1]
model = "irb6_postument"
synchro = "known_pose"
)";

struct Ended {
  int status{};
  std::string out, err;
};

class RunTask : public testing::Test {
 protected:
  RunTask() : folder_(fs::temp_directory_path() / ("mrroc_run_task_" + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
    task_ = {.name = "dip",
             .about = "One arm dips a brush.",
             .config = kConfig,
             .arms = {{"arm1", "irb6_postument"}},
             .ecp = [](link::Process&, const Config&, const link::NodeArguments&) {}};
    task_.receptors.push_back(
        {.name = "wetness", .body = task_.ecp, .read = [this](const Config&) { done("receptor"); }});
    task_.options = [this](CommandLine& line) { line.flag("--deep", deep_, "dips to the handle"); };
    task_.found = [this](mp::TaskOptions&) {
      done("found");
      return std::vector<std::string>{"task.force=5"};
    };
    task_.complete = [this](Config&, const mp::TaskOptions&) { done("complete"); };
    task_.prepare = [this](const launch::Setup& s) {
      done("prepare");
      force_ = s.config.section("task").number("force", 1, {1, 9}, "N");
    };
    task_.coordinator = [this](mp::TaskRun&, const launch::Setup&) {
      done("coordinator");
      return nullptr;
    };
  }
  ~RunTask() override { fs::remove_all(folder_); }

  void done(const std::string& what) { order_.push_back(what); }

  Ended run(std::vector<std::string> words) {
    words.insert(words.begin(), {"dip", "--run-dir", (folder_ / "run").string()});
    std::vector<char*> argv;
    for (std::string& w : words) argv.push_back(w.data());
    argv.push_back(nullptr);
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Ended e;
    e.status = run_task(task_, static_cast<int>(words.size()), argv.data());
    e.out = testing::internal::GetCapturedStdout();
    e.err = testing::internal::GetCapturedStderr();
    return e;
  }
  [[nodiscard]] bool began() const { return fs::exists(folder_ / "run"); }

  Task task_;
  bool deep_{};
  double force_{};
  std::vector<std::string> order_;

 private:
  fs::path folder_;
};

using Names = std::vector<std::string>;

TEST_F(RunTask, AnOptionOfTheTaskWithoutItsValueIsToldWithAnExampleOfTheTask) {
  std::string brush;
  task_.options = [&](CommandLine& line) { line.option("--brush", brush, "that is dipped"); };
  task_.examples = {"./run dip --brush wide"};
  const Ended e = run({"--brush"});
  EXPECT_EQ(e.status, 2);
  EXPECT_NE(e.err.find("`./run dip --brush wide`"), std::string::npos) << e.err;
  EXPECT_FALSE(began());
}

TEST_F(RunTask, HelpHasTheTasksWordsAndOptionsAndDoesNothing) {
  const Ended e = run({"--help"});
  EXPECT_EQ(e.status, 0) << e.err;
  EXPECT_NE(e.out.find("One arm dips a brush."), std::string::npos) << e.out;
  EXPECT_NE(e.out.find("--deep"), std::string::npos);
  EXPECT_NE(e.out.find("--seed"), std::string::npos) << "an option of every task";
  EXPECT_TRUE(order_.empty());
  EXPECT_FALSE(began());
}

TEST_F(RunTask, ParametersAreListedAsTheTaskAndItsSettingsHaveThemWithoutARun) {
  const Ended e = run({"--parameters", "--deep", "--set", "robots.arm1.synchro=homing"});
  EXPECT_EQ(e.status, 0) << e.err;
  EXPECT_TRUE(deep_);
  EXPECT_EQ(force_, 5) << "what the task finds out stands above its file";
  EXPECT_NE(e.out.find("task.force"), std::string::npos) << e.out;
  EXPECT_NE(e.out.find("homing"), std::string::npos);
  EXPECT_EQ(order_, (Names{"found", "complete", "receptor", "prepare"}));
  EXPECT_FALSE(began());
}

TEST_F(RunTask, WhatIsSetByHandStandsAboveWhatTheTaskFindsOut) {
  EXPECT_EQ(run({"--parameters", "--set", "task.force=7"}).status, 0);
  EXPECT_EQ(force_, 7);
}

TEST_F(RunTask, AnErrorOfAValueThatAnOptionSetsNamesTheOption) {
  task_.typed = {{"task.force", "--force"}};
  task_.prepare = [](const launch::Setup&) {
    throw FaultError(FaultCode::bad_configuration, "task.force: it breaks the brush");
  };
  const Ended e = run({});
  EXPECT_EQ(e.status, 2);
  EXPECT_NE(e.err.find("--force 5: it breaks the brush; correct that option"), std::string::npos) << e.err;
  task_.found = {};
  EXPECT_NE(run({}).err.find("task.force: it breaks the brush"), std::string::npos)
      << "a key that is not from an option keeps its name";
}

TEST_F(RunTask, AValueThatAnOptionAndSetGiveIsRefused) {
  task_.typed = {{"task.force", "--force"}};
  const Ended e = run({"--set", "task.force=7"});
  EXPECT_EQ(e.status, 2);
  EXPECT_NE(e.err.find("--force and --set task.force give the same value; leave out one of them"),
            std::string::npos)
      << e.err;
  EXPECT_FALSE(began());
}

TEST_F(RunTask, WhatIsWrongIsToldBeforeAnythingStarts) {
  const std::vector<std::pair<Names, std::string>> all{
      {{"--set", "task.force=70"}, "task.force"},
      {{"--set", "task.farce=7"}, "task.farce"},
      {{"--set", "robots.arm1.model=crane"}, "crane"},
      {{"--set", "robots.order=['arm2']"}, "robots.order"},
      {{"--set", "robots.arm1.hardware=3"}, "robots.arm1.hardware"},
      {{"--set", "robots.arm1.hardware=loopbak"}, "it has simulated, loopback"},
      {{"--set", "robots.arm1.start_joints=[0,0,0]"}, "robots.arm1.start_joints: "},
      {{"--set", "robots.arm1.fingers=two_layers"}, "robots.arm1.gripper"},
      {{"--set", "cube.held_by=arm1"}, "cube.held_by: arm1 has no fingers"},
      {{"--shallow"}, "--shallow"},
      {{"--check", "/no/such/run"}, "/no/such/run"}};
  for (const auto& [words, named] : all) {
    order_.clear();
    const Ended e = run(words);
    EXPECT_EQ(e.status, 2) << words.back() << e.out << e.err;
    EXPECT_NE(e.err.find(named), std::string::npos) << words.back() << e.err;
    EXPECT_EQ(std::ranges::count(order_, "coordinator"), 0) << words.back();
    EXPECT_FALSE(began()) << words.back();
  }
}

TEST_F(RunTask, AFaultOfItsPreparationIsTheTasksEnd) {
  task_.prepare = [](const launch::Setup&) {
    throw FaultError(FaultCode::bad_configuration, "the brush has no bristles", "take another brush");
  };
  const Ended e = run({});
  EXPECT_EQ(e.status, 2) << e.out;
  EXPECT_NE(e.err.find("the brush has no bristles"), std::string::npos) << e.err;
  EXPECT_NE(e.err.find("take another brush"), std::string::npos) << e.err;
  EXPECT_FALSE(began());
}

TEST_F(RunTask, OptionsThatSayWhatAConfigurationSaysStandAlone) {
  task_.instead_of_config = {"--deep"};
  const Ended e = run({"--deep", "--config", "some.toml"});
  EXPECT_EQ(e.status, 2);
  EXPECT_NE(e.err.find("--deep"), std::string::npos) << e.err;
  EXPECT_TRUE(order_.empty());
}

}  // namespace
}  // namespace mrroc::launch
