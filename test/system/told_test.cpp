// Messages of a run to a person or a script: progress, what it waits for, its figures, the parameters that
// can be set.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <sstream>
#include <thread>

#include "base/file_content.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/text.hpp"
#include "mrroc/console_t.hpp"
#include "test/system/started_task.hpp"

namespace mrroc::test {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begun) {
  return std::chrono::duration<double>(Clock::now() - begun).count();
}

/// @return arguments of a run in one process
std::vector<std::string> in_one(const Folder& folder, const std::vector<std::string>& more) {
  return words({{"--processes", "one", "--run-dir", (folder / "run").string()}, more});
}

/// @return lines of MP in messages.log, without the columns before the text
std::vector<std::string> messages(const std::filesystem::path& run) {
  constexpr std::size_t kColumns = 10 + 2 + 10 + 2 + 9 + 2 + 20 + 2;
  std::istringstream in(file_content(run / "messages.log"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (line.size() > kColumns && line.substr(12, 2) == "mp") lines.push_back(line.substr(kColumns));
  return lines;
}

TEST(Told, ProgressIsInTheMessagesOfEveryArrangementOfProcesses) {
  const std::vector<std::string> told{"arm1  m = 1  approach", "arm1  m = 2  settle", "arm1  m = 3  hold",
                                      "arm1  m = 4  draw back", "arm1  m = 0  done"};
  for (const std::string mode : {"one", "separate"}) {
    if (mode == "separate" && !multicast()) continue;
    SCOPED_TRACE(mode);
    const Folder folder;
    const Ended ended = run(folder, "press", {"--processes", mode, "--run-dir", (folder / "run").string()});
    ASSERT_EQ(ended.status, 0) << ended.all();
    const auto lines = messages(folder / "run");
    std::vector<std::string> logged;
    for (const auto& [stamp, line] : link::LogReader(folder / "run").messages<console_t>("mp.console"))
      logged.push_back(link::get_text(line.text));
    for (const std::string& text : told) {
      EXPECT_TRUE(std::ranges::find(lines, text) != lines.end()) << text;
      EXPECT_TRUE(std::ranges::find(logged, text) != logged.end()) << text;
      EXPECT_TRUE(std::ranges::any_of(ended.out, [&](const auto& line) {
        return line.ends_with(" s  " + text);
      })) << text;
    }
  }
}

TEST(Told, TheCubeTellsOfItsTurnsAndAtLastThatItIsSolved) {
  if (kSanitized) GTEST_SKIP() << "too long";
  const Folder folder;
  const Ended ended = run(folder, "rubik", in_one(folder, {"--scramble", "R", "--eyes", "none"}));
  ASSERT_EQ(ended.status, 0) << ended.all();
  const auto lines = messages(folder / "run");
  ASSERT_FALSE(lines.empty());
  EXPECT_EQ(lines.back(), "the cube is solved");
  for (const std::string begin : {"solution: 1 turn: R'; ", "move 1 of 1: R'", "turned in "})
    EXPECT_TRUE(std::ranges::any_of(lines, [&](const auto& line) { return line.starts_with(begin); }))
        << begin;
}

TEST(Told, ARunThatIsOutOfTimeEndsAndSaysForWhatItWaited) {
  const Folder folder;
  const Ended ended = run(folder, "press", in_one(folder, {"--max-time", "1.5"}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: time_limit: ")) << ended.all();
  EXPECT_NE(ended.last_err().find("m = 1, approach, goes on until: F_z above 0.9 of the force"),
            std::string::npos)
      << ended.last_err();
  const auto s = summary(folder / "run");
  EXPECT_EQ(s.at("outcome"), "fault");
  EXPECT_EQ(s.at("fault").at("code"), "time_limit");
  EXPECT_NEAR(s.at("sim_s").get<double>(), 1.5, 0.2);
  EXPECT_LE(figure(s, "stop_steps_max"), 100) << "in a controlled way";
}

TEST(Told, ALimitThatIsNotReachedChangesNothing) {
  const Folder folder;
  const Ended ended = run(folder, "press", in_one(folder, {"--max-time", "60"}));
  EXPECT_EQ(ended.status, 0) << ended.all();
}

TEST(Told, AScriptWithoutAStartIsToldAtOnceAndEndsTheRunWithinSeconds) {
  if (kSanitized) GTEST_SKIP() << "by wall time";
  const Folder folder;
  const auto begun = Clock::now();
  Started press(folder, "press", in_one(folder, {"--script", folder.write("orders", "# nobody starts\n")}));
  EXPECT_TRUE(press.await_line("the script has ended; the run waits for start: `ui_cli start`"));
  EXPECT_LT(seconds_since(begun), 9);
  const Ended ended = press.end();
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: script_ended: ")) << ended.all();
  EXPECT_LT(seconds_since(begun), 30);
  EXPECT_LT(std::filesystem::file_size(folder / "run" / "events.lcmlog"), 20'000'000U);
}

TEST(Told, AScriptWithoutATriggerNamesTheTriggerAndATerminalKeepsTheRunAlive) {
  if (kSanitized) GTEST_SKIP() << "by wall time";
  if (!multicast()) GTEST_SKIP() << "no multicast here";
  const Folder folder;
  Started drawing(folder, "drawing",
                  {"--drawing", folder.write("line.svg", lines_svg(1)), "--size", "12", "--run-dir",
                   (folder / "run").string(), "--script", folder.write("orders", "3 start\n")});
  ASSERT_TRUE(drawing.await_line("the script has ended; the run waits for trigger 1: `ui_cli trigger`"))
      << drawing.end().all();
  EXPECT_EQ(run(folder, "ui_cli", {"pause"}).status, 0);
  EXPECT_EQ(run(folder, "ui_cli", {"resume"}).status, 0);
  std::this_thread::sleep_for(std::chrono::seconds(12));
  EXPECT_EQ(run(folder, "ui_cli", {"trigger"}).status, 0) << "it still waits";
  ASSERT_TRUE(drawing.await_line("waits for trigger 2")) << drawing.end().all();
  EXPECT_EQ(run(folder, "ui_cli", {"trigger"}).status, 0);
  const Ended ended = drawing.end();
  EXPECT_EQ(ended.status, 0) << ended.all();
}

TEST(Told, InstructionsThatLackTheEndEndTheRunOfTheManualOperation) {
  if (kSanitized) GTEST_SKIP() << "by wall time";
  const Folder folder;
  const Ended ended =
      run(folder, "manual", in_one(folder, {"--words", folder.write("words", "20 stop arm1\n")}));
  EXPECT_EQ(ended.status, 1) << ended.all();
  EXPECT_TRUE(ended.last_err().starts_with("error: script_ended: ")) << ended.all();
  EXPECT_NE(ended.all().find("`ui_cli manual end`"), std::string::npos) << ended.all();
}

TEST(Told, AFigureThatIsMissedIsToldAlwaysAndIsAnErrorWithStrict) {
  for (const bool strict : {false, true}) {
    const Folder folder;
    std::vector<std::string> arguments{"--set", "sim.paper.stiffness=150"};
    if (strict) arguments.emplace_back("--strict");
    const Ended ended = run(folder, "press", in_one(folder, arguments));
    EXPECT_EQ(ended.status, strict ? 1 : 0) << ended.all();
    ASSERT_GE(ended.out.size(), 2U);
    const std::string& told = ended.out[ended.out.size() - 2];
    EXPECT_NE(told.find(" of 2 figures missed what is wanted: "), std::string::npos) << ended.all();
    EXPECT_TRUE(told.starts_with("done; ")) << told;
    EXPECT_EQ(ended.last_err().starts_with("error: figures_missed: "), strict) << ended.all();
  }
}

TEST(Told, TheForceOfPressIsAParameterOverItsWholeRange) {
  for (const double force : {1.0, 2.5, 10.0}) {
    const Folder folder;
    const Ended ended =
        run(folder, "press", in_one(folder, {"--strict", "--set", "task.force=" + std::to_string(force)}));
    EXPECT_EQ(ended.status, 0) << ended.all();
    EXPECT_NEAR(figure(summary(folder / "run"), "hold_N"), force, 0.025 * force);
  }
}

TEST(Told, EveryTaskListsItsParametersWithoutARun) {
  const std::vector<std::pair<std::string, std::string>> keys{
      {"press", "task.force"},          {"drawing", "task.draw_force"},          {"rubik", "task.tables"},
      {"visual_servo", "object.pose"},  {"edge_follow", "task.speed_per_force"}, {"weigh", "task.readings"},
      {"manual", "sim.paper.stiffness"}};
  for (const auto& [task, key] : keys) {
    const Folder folder;
    const auto run_dir = folder / "run";
    const Ended table = run(folder, task, {"--parameters", "--run-dir", run_dir.string()});
    EXPECT_EQ(table.status, 0) << table.all();
    EXPECT_FALSE(std::filesystem::exists(run_dir)) << task;
    ASSERT_GT(table.out.size(), 50U) << table.all();
    EXPECT_TRUE(table.out[0].starts_with("key ")) << table.out[0];
    EXPECT_TRUE(std::ranges::any_of(table.out, [&, &key = key](const auto& line) {
      return line.starts_with(key + " ");
    })) << task;
    const Ended list = run(folder, task, {"--parameters", "--json"});
    std::string text;
    for (const std::string& line : list.out) text += line + "\n";
    const auto json = nlohmann::json::parse(text, nullptr, false);
    ASSERT_TRUE(json.is_array()) << task;
    EXPECT_EQ(json.size() + 1, table.out.size()) << task;
  }
  const Folder folder;
  const Ended set = run(folder, "press", {"--parameters", "--set", "task.force=6"});
  EXPECT_TRUE(std::ranges::any_of(set.out, [](const auto& line) {
    return line.starts_with("task.force ") && line.find(" 6.0 ") != std::string::npos &&
           line.find("1 to 10") != std::string::npos && line.ends_with("N");
  })) << set.all();
  EXPECT_EQ(run(folder, "press", {"--parameters", "--set", "task.farce=6"}).status, 2);
}

}  // namespace
}  // namespace mrroc::test
