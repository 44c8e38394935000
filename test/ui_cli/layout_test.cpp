// The room on the screen: what is shown on terminals of any size.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "test/ui_cli/laid_out.hpp"

namespace mrroc::test {
namespace {

std::string bars(const std::string& bar, int count) {
  std::string text;
  for (int k = 0; k < count; ++k) text += bar;
  return text;
}

TEST(Layout, ShowsTheWholeTaskOnASmallTerminal) {
  const Canvas c = lay_out(drawing(), kSmallTerminal);
  expect_seen(c, {"drawing   session drawing-1a2b",
                  "running",
                  "m 5  draw on the paper",
                  "i 617",
                  "12.34 s simulated",
                  "8.1 x",
                  "after lowering: both pens settled on the paper",
                  "63 %",
                  "stroke 3 of 6",
                  "812.3",
                  "-250.0",
                  "3.142",
                  "1.02",
                  "0.92",
                  "paper_surface",
                  "copy the coordinator's orders",
                  "0..2 N",
                  "simulator",
                  "edp arm1",
                  "vsp arm2",
                  "all processes are ready",
                  "edp arm1: lost_command: number 7 expected",
                  "s start",
                  "p pause",
                  "r resume",
                  "t trigger",
                  "x stop",
                  "? help",
                  "e E-STOP",
                  "q leave"});
}

TEST(Layout, ShowsAPlatformWithItsHeadingAndSpeedAndAnAgentWithoutAnEffectorInARow) {
  const Canvas c = lay_out(driving(), kSmallTerminal);
  expect_seen(c, {"phi [deg]", "v [m/s]", "812.3", "12.4", "-90.0", "0.58", "odometry 260, map 0.1 s",
                  "execute the plan", " v ", "m/s"});
  for (const char* of_arms : {"F_z", "z [mm]", "rotation"}) EXPECT_EQ(row_of(c, of_arms), -1) << c.text();
  const std::string map = c.text(row_of(c, " map  "));
  EXPECT_NE(map.find("m 1  locate"), std::string::npos) << map;
  EXPECT_EQ(row_of(c, " map  ") + 2, row_of(c, "PROCESS")) << "no chart of it\n" << c.text();
  expect_seen(lay_out(driving(), {40, 120}), {"w [rad/s]", "-0.33"});
}

TEST(Layout, ArmsAndPlatformsHaveHeadingsOfTheirOwn) {
  View v = driving();
  v.snapshot->agents[1].effector = EffectorKind::arm;
  const Canvas c = lay_out(v, {40, 80});
  EXPECT_LT(row_of(c, "F_z [N]"), row_of(c, "phi [deg]")) << c.text();
  expect_seen(c, {" v ", " F_z "});
}

TEST(Layout, APlatformHasNoPlaceBeforeItKnowsIt) {
  View v = driving();
  v.snapshot->agents[0].position_known = false;
  const Canvas c = lay_out(v, kSmallTerminal);
  for (const char* unknown : {"812.3", "-90.0", "0.58"}) EXPECT_EQ(row_of(c, unknown), -1) << unknown;
  expect_seen(c, {"odometry 260"});
}

TEST(Layout, ShowsTheChartsOfTheLargestTaskOnASmallTerminalAndCountsTheProcessesThatAreWell) {
  View v = largest();
  for (int k = 0; k < 4; ++k) v.snapshot->agents[k].name = "arm" + std::to_string(k + 1);
  for (int k = 0; k < 100; ++k) v.history.add(*v.snapshot);
  Canvas c = lay_out(v, kSmallTerminal);
  int charts = 0;
  for (int row = 0; row < c.size().rows; ++row) charts += c.text(row).starts_with(" F_z");
  EXPECT_EQ(charts, 4) << c.text();
  expect_seen(c, {"and 15 more are well", "lost_command", "q leave"});
  v.snapshot->processes[13].state = link::ProcessState::dead;
  c = lay_out(v, kSmallTerminal);
  expect_seen(c, {"process 13", "and 15 more are well", " F_z"});
  v.snapshot->processes[13].state = link::ProcessState::running;
  expect_seen(lay_out(v, {24, 79}), {"all 16 are well"});
}

TEST(Layout, ShowsEveryProcessOfTheLargestTaskOnALargeTerminal) {
  const Canvas c = lay_out(largest(), {40, 80});
  for (int k = 0; k < 16; ++k) expect_seen(c, {"process " + std::to_string(k), " F_z"});
  EXPECT_EQ(row_of(c, "are well"), -1) << c.text();
}

TEST(Layout, TheEmergencyStopAndTheHelpAreTheLastKeysToGo) {
  View v = drawing();
  for (int columns = 12; columns <= 200; ++columns)
    for (const char* task : {"drawing", "manual"}) {
      v.snapshot->task = task;
      const std::string keys = lay_out(v, {15, columns}).text(14);
      EXPECT_NE(keys.find("e E-STOP"), std::string::npos) << columns << keys;
      EXPECT_NE(keys.find(" ?"), std::string::npos) << columns << keys;
    }
  const std::string narrow = lay_out(v, {15, 40}).text(14);
  EXPECT_NE(narrow.find("p pause"), std::string::npos) << narrow;
  EXPECT_EQ(narrow.find("r resume"), std::string::npos) << "it means nothing now: " << narrow;
}

TEST(Layout, GivesALargeTerminalsRoomToChartsAndMessages) {
  View v = drawing();
  for (int k = 0; k < 30; ++k) v.messages.push_back({"mp", FaultCode::none, "line " + std::to_string(k)});
  const Canvas small = lay_out(v, kSmallTerminal);
  const Canvas large = lay_out(v, {50, 160});
  const auto lines = [](const Canvas& c) {
    int count = 0;
    for (int row = 0; row < c.size().rows; ++row) count += c.text(row).find("mp: line") != std::string::npos;
    return count;
  };
  EXPECT_GE(lines(small), 1);
  EXPECT_GT(lines(large), lines(small) + 5);
  EXPECT_GT(row_of(large, "PROCESS"), row_of(small, "PROCESS"));
  expect_seen(large, {"F_x [N]", "line 29"});
}

TEST(Layout, KeepsStateNoticeAndKeysOnAnySize) {
  View v = largest();
  v.snapshot->agents[2].effector = EffectorKind::platform;
  v.snapshot->agents[3].effector = EffectorKind::none;
  v.notice = {"stop the task for good? y/n", Style::warning};
  for (int rows = 0; rows <= 60; ++rows)
    for (const int columns : {0, 1, 20, 39, 40, 79, 80, 81, 200}) {
      const Canvas c = lay_out(v, {rows, columns});
      EXPECT_EQ(c.size(), (Size{rows, columns}));
      if (columns < 40 || rows < 3) continue;
      EXPECT_NE(c.text(0).find("running"), std::string::npos);
      EXPECT_EQ(row_of(c, "stop the task for good? y/n"), rows - 2);
      EXPECT_EQ(row_of(c, "e E-STOP"), rows - 1);
    }
}

TEST(Layout, SaysWhenProcessesAreHiddenAndShowsTheTroubledOnes) {
  View v = largest();
  v.snapshot->processes[13].state = link::ProcessState::dead;
  const Canvas c = lay_out(v, {18, 80});
  expect_seen(c, {"process 13", "more are well"});
  EXPECT_EQ(style_of(c, "dead"), Style::bad);
}

TEST(Layout, TextsOfOneRowDoNotTouchOnANarrowTerminal) {
  View v = drawing();
  v.snapshot->behaviour = "lead both arms to the start of the drawing";
  v.snapshot->waits_for_trigger = true;
  v.snapshot->early = "the hand is still drawing: 33 %";
  v.session = "drawing-of-a-session-with-quite-a-long-name-of-its-own";
  for (int columns = 60; columns < 130; ++columns) {
    const Canvas c = lay_out(v, {15, columns});
    EXPECT_NE(c.text(0).find("  running"), std::string::npos) << c.text(0);
    const std::string task = c.text(1);
    EXPECT_EQ(task.find("m 5  lead both"), 1U) << task;
    const auto times = task.find("12.34 s");
    ASSERT_NE(times, std::string::npos) << task;
    EXPECT_TRUE(task.substr(times - 2, 2) == "  " || task.substr(times - 2, 2) == ", ") << task;
    EXPECT_NE(c.text(2).find(" press t later: the hand is still drawing: 33 %"), std::string::npos)
        << c.text(2);
    EXPECT_NE(c.text(14).find(columns < 66 ? " ? q" : "q leave"), std::string::npos) << c.text(14);
  }
}

TEST(Layout, CutsNoWordOnASmallTerminal) {
  View v = drawing();
  v.notice = {
      "trigger refused: the hand is still drawing: 33 %; give it again when the hand has come to its end",
      Style::warning};
  v.messages.push_back(
      {"mp", FaultCode::none, "a line of a process that is longer than the narrowest terminal is wide"});
  const auto words_of = [](const Canvas& c, int from, int to) {
    std::vector<std::string> words;
    for (int row = from; row < to; ++row) {
      std::istringstream line(c.text(row));
      for (std::string word; line >> word;) words.push_back(word);
    }
    return words;
  };
  for (const bool help : {false, true}) {
    v.help = help;
    const auto whole = words_of(lay_out(v, {60, 200}), 0, 60);
    for (int columns = 60; columns <= 130; columns += 5) {
      const Canvas c = lay_out(v, {15, columns});
      const int keys = 14;
      for (int row = help ? 1 : 4; row < keys; ++row) {
        if (c.text(row).starts_with(" F_z") || c.text(row).ends_with(" are well")) continue;
        for (const std::string& word : words_of(c, row, row + 1))
          EXPECT_TRUE(word.ends_with("..") || std::ranges::count(whole, word) > 0)
              << "'" << word << "' in " << columns << " columns\n"
              << c.text();
      }
      EXPECT_TRUE(c.text(keys - 1).ends_with(" end")) << c.text();
    }
  }
}

TEST(Layout, KeepsItsColumnsWhateverTheNumbersAre) {
  View v = drawing();
  const Canvas before = lay_out(v, kSmallTerminal);
  for (const double value : {std::nan(""), HUGE_VAL, -1e300, 123456789.0, -0.0}) {
    v.snapshot->agents[0].T_0E.fill(value);
    v.snapshot->agents[0].F_a.fill(value);
    v.snapshot->sim_time = value;
    v.snapshot->speed = value;
    v.history.add(*v.snapshot);
    const Canvas c = lay_out(v, kSmallTerminal);
    EXPECT_EQ(c.text(row_of(c, "arm1")).find("paper_surface"),
              before.text(row_of(before, "arm1")).find("paper_surface"))
        << c.text();
  }
}

TEST(Layout, CannotBeMadeToSpeakToTheTerminal) {
  View v = drawing();
  v.messages.push_back({"mp", FaultCode::none, "\x1b[2J\x07\n"});
  const std::string text = lay_out(v, kSmallTerminal).text();
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
  EXPECT_EQ(text.find('\x07'), std::string::npos);
}

TEST(Layout, DrawsTheForceOfEveryAgent) {
  View v = drawing();
  for (ui::AgentView& a : v.snapshot->agents) a.behaviour.clear();  // more room for the charts
  v.glyphs = ui::Glyphs::unicode;
  const Canvas c = lay_out(v, kSmallTerminal);
  // 1.02 N and 0.92 N of 2 N: the ninth and the eighth of the sixteen levels of two rows.
  const int first = row_of(c, "arm1"), second = row_of(c, "arm2");
  EXPECT_EQ(c.text(first + 1), " F_z      " + bars("▁", 59) + " 2");
  EXPECT_EQ(c.text(first + 2), "          " + bars("█", 59) + " 0 N");
  EXPECT_EQ(c.text(second + 1), " F_z" + std::string(66, ' ') + "2");
  EXPECT_EQ(c.text(second + 2), "          " + bars("█", 59) + " 0 N");
}

}  // namespace
}  // namespace mrroc::test
