// Two platforms push a box, as a user starts them.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

/// Platforms that stand behind the box already.
std::vector<std::string> short_push(const Folder& folder, const std::string& name) {
  return {"--to",      "0.8",
          "0",         "0",
          "--set",     "sim.platforms.rex1.start=[-1.1, 0.54, 0]",
          "--set",     "sim.platforms.rex2.start=[-1.1, -0.54, 0]",
          "--run-dir", (folder / name).string()};
}

TEST(BoxPush, BringsTheBoxToItsGoalWithTheSameBitsInOneProcessAndInSeveral) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder;
  nlohmann::json told[2];
  for (const bool one : {false, true}) {
    const std::string name = one ? "one" : "separate";
    const Ended ended = run(folder, "box_push", words({short_push(folder, name), {"--processes", name}}));
    ASSERT_EQ(ended.status, 0) << ended.all();
    told[one ? 1 : 0] = summary(folder / name);
  }
  EXPECT_NE(told[0].at("log_hash"), "0000000000000000");
  EXPECT_EQ(told[0].at("log_hash"), told[1].at("log_hash"));
  EXPECT_EQ(told[0].at("figures"), told[1].at("figures"));
  EXPECT_LE(figure(told[0], "box_err_mm"), 30);
  EXPECT_LE(figure(told[0], "box_err_deg"), 5);
  EXPECT_GT(figure(told[0], "push_mean_N"), 275) << "more than the traction of one platform";
}

TEST(BoxPush, StandsDuringAPauseAndComesToItsGoal) {
  const Folder folder;
  const std::string script = folder.write("orders", "3 start\n500 pause\n550 resume\n");
  const Ended ended =
      run(folder, "box_push", words({short_push(folder, "run"), {"--processes", "one", "--script", script}}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  EXPECT_LE(figure(summary(folder / "run"), "box_err_mm"), 30);
}

/// @return speed of the box when its log ends [m/s]
double last_speed(const Folder& folder, const std::string& name) {
  const Ended log =
      run(folder, "ui_cli", {"log", "show", (folder / name).string(), "--channel", "box.truth", "--json"});
  const auto truth = nlohmann::json::parse(log.last_out());
  return std::hypot(truth.at("speed[0]").get<double>(), truth.at("speed[1]").get<double>());
}

TEST(BoxPush, EndsInWordsOfItsOwnWhenTheBoxDoesNotMoveOrIsNotThereYet) {
  const Folder folder;
  struct Case {
    const char* name;
    std::vector<std::string> more;
  };
  for (const auto& [name, more] :
       {Case{"box_not_moved", {"--set", "sim.boxes.box.friction=1.2"}},
        Case{"box_not_there_yet", {"--set", "task.pushes=1", "--box", "0", "0.6", "0"}},
        Case{"no_way_for_box", {"--set", "room.walls=[-5, -1.2, 5, 1.2]", "--box", "0.3", "0", "90"}}}) {
    const Ended ended =
        run(folder, "box_push", words({short_push(folder, name), {"--processes", "one"}, more}));
    EXPECT_EQ(ended.status, 1) << ended.all();
    EXPECT_TRUE(ended.last_err().starts_with(std::string("error: ") + name + ": ")) << ended.all();
  }
}

class BoxPushWithADeath : public ::testing::TestWithParam<const char*> {};

TEST_P(BoxPushWithADeath, EndsAndNamesTheProcessAndPlatformsAndBoxStand) {
  if (!multicast()) GTEST_SKIP() << "no multicast";
  const Folder folder(false);
  const std::string part = GetParam();
  Started task(folder, "box_push",
               words({short_push(folder, "run"), {"--processes", "separate", "--speed", "4"}}));
  ASSERT_TRUE(task.await_line("  push")) << task.end().all();
  std::this_thread::sleep_for(std::chrono::milliseconds(2000));  // 8 s: the box moves
  const std::vector<ProcessId> children = task.children();
  ::kill(task.child(part).pid, SIGKILL);
  const Ended ended = task.end();
  EXPECT_EQ(ended.status, 3) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: process_died: ")) << ended.all();
  EXPECT_NE(ended.last_err().find(part), std::string::npos) << ended.all();
  EXPECT_TRUE(all_gone(children));
  if (part == "simulator") return;  // and with it what could move
  EXPECT_LE(figure(summary(folder / "run"), "stop_steps_max"), 300);
  EXPECT_LT(last_speed(folder, "run"), 1e-3);
}

INSTANTIATE_TEST_SUITE_P(Of, BoxPushWithADeath,
                         ::testing::Values("simulator", "edp-rex1", "edp-rex2", "ecp-rex1", "ecp-rex2",
                                           "ecp-map1", "ecp-map2"),
                         [](const auto& named) {
                           std::string name = named.param;
                           std::erase(name, '-');
                           return name;
                         });

TEST(BoxPush, RefusesAGoalThatIsNoneBeforeAnythingStarts) {
  const Folder folder;
  for (const auto& [to, named] :
       {std::pair<std::vector<std::string>, std::string>{{"4.9", "0", "0"}, "--to [4.9, 0, 0]: "},
        {{"1", "2"}, "--to"}}) {
    const Ended ended =
        run(folder, "box_push", words({{"--to"}, to, {"--run-dir", (folder / "run").string()}}));
    EXPECT_EQ(ended.status, 2) << ended.all();
    EXPECT_NE(ended.all().find(named), std::string::npos) << ended.all();
    EXPECT_FALSE(std::filesystem::exists(folder / "run"));
  }
}

}  // namespace
}  // namespace mrroc::test
