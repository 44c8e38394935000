// The state of a task on the screen.
#include <gtest/gtest.h>

#include "test/ui_cli/laid_out.hpp"

namespace mrroc::test {
namespace {

TEST(Layout, SaysWhatAPauseIs) {
  View v = drawing();
  v.snapshot->state = TaskState::paused;
  EXPECT_EQ(style_of(lay_out(v, kSmallTerminal), "arms rest and keep their forces: press r to go on"),
            Style::warning);
}

TEST(Layout, AfterTheEndTheKeysSayThatItIsOver) {
  View v = drawing();
  v.snapshot->state = TaskState::ended;
  const Canvas c = lay_out(v, kSmallTerminal);
  EXPECT_EQ(row_of(c, "the task is over   q leave"), 23);
  EXPECT_EQ(row_of(c, "x stop"), -1);
}

TEST(Layout, AnEmergencyStopIsTheHeadlineUntilTheEndAndOldValuesGo) {
  for (const TaskState state : {TaskState::stopping, TaskState::ending, TaskState::ended}) {
    View v = drawing();
    v.snapshot->fault = FaultCode::emergency_stop;
    v.snapshot->state = state;
    v.snapshot->agents[0].F_a[2] = 3.21;
    v.snapshot->agents[0].T_0E[0] = 0.8765;
    const Canvas c = lay_out(v, kSmallTerminal);
    EXPECT_EQ(style_of(c, "EMERGENCY STOP, " + std::string(to_string(state))), Style::bad);
    EXPECT_EQ(c.text(1).find(" x"), std::string::npos) << "no pace: " << c.text(1);
    for (const char* old : {"3.21", "876.5"}) EXPECT_EQ(row_of(c, old), -1) << old << "\n" << c.text();
    expect_seen(c, {"ended in m "});
  }
}

TEST(Layout, SaysHowATaskEnds) {
  View v = drawing();
  v.snapshot->state = TaskState::ended;
  for (const auto& [fault, words] : {std::pair{FaultCode::operator_stop, "stopped, ended"},
                                     {FaultCode::interrupted, "interrupted, ended"},
                                     {FaultCode::too_fast, "FAULT too_fast, ended"}}) {
    v.snapshot->fault = fault;
    expect_seen(lay_out(v, kSmallTerminal), {words});
  }
  v.snapshot->fault = FaultCode::none;
  const Canvas c = lay_out(v, kSmallTerminal);
  EXPECT_NE(c.text(0).find(" ended"), std::string::npos);
  EXPECT_EQ(c.text(0).find(','), std::string::npos) << c.text(0);
}

TEST(Layout, MarksAProcessThatHasNotBeenHeard) {
  View v = drawing();
  v.snapshot->processes[2].age = 7.5;
  v.snapshot->processes[2].state = link::ProcessState::running;
  const Canvas c = lay_out(v, kSmallTerminal);
  const int row = row_of(c, "edp arm1 ");
  EXPECT_NE(c.text(row).find("7.5 s"), std::string::npos);
  EXPECT_EQ(c.cell(row, 1 + 22).style, Style::bad);
  EXPECT_EQ(c.cell(row, static_cast<int>(c.text(row).find("7.5 s"))).style, Style::bad);
}

TEST(Layout, ShowsWhatCanBeDoneNow) {
  View v = drawing();
  v.snapshot->waits_for_trigger = true;
  Canvas c = lay_out(v, kSmallTerminal);
  EXPECT_EQ(style_of(c, "p pause"), Style::heading);
  EXPECT_EQ(style_of(c, "t trigger"), Style::heading);
  EXPECT_EQ(style_of(c, "r resume"), Style::dim);
  EXPECT_EQ(style_of(c, "waits for your trigger"), Style::warning);
  v.snapshot->state = TaskState::paused;
  c = lay_out(v, kSmallTerminal);
  EXPECT_EQ(style_of(c, "p pause"), Style::dim);
  EXPECT_EQ(style_of(c, "t trigger"), Style::dim);
  EXPECT_EQ(style_of(c, "r resume"), Style::heading);
  v.snapshot->state = TaskState::ending;
  EXPECT_EQ(style_of(lay_out(v, kSmallTerminal), "x stop"), Style::dim);
}

TEST(Layout, SaysThatTheTaskIsSilentInsteadOfItsLastState) {
  View v = drawing();
  v.silence = 3.4;
  const Canvas c = lay_out(v, kSmallTerminal);
  EXPECT_EQ(style_of(c, "NO NEWS FOR 3 s"), Style::bad);
  v.snapshot->state = TaskState::ended;
  EXPECT_EQ(row_of(lay_out(v, kSmallTerminal), "NO NEWS"), -1) << "a task that has ended may be silent";
}

TEST(Layout, SaysThatNoStatusHasComeYet) {
  View v;
  v.session = "s";
  expect_seen(lay_out(v, kSmallTerminal), {"session s", "NO STATUS YET", "q leave"});
}

TEST(Layout, ColoursMessagesByTheirClass) {
  View v = drawing();
  v.messages = {{"mp", FaultCode::none, "information"},
                {"edp arm1", FaultCode::lost_command, ""},
                {"edp arm2", FaultCode::over_current, ""},
                {"mp", FaultCode::process_died, ""}};
  const Canvas c = lay_out(v, {32, 80});
  EXPECT_EQ(style_of(c, "mp: information"), Style::plain);
  EXPECT_EQ(style_of(c, "edp arm1: lost"), Style::warning);
  EXPECT_EQ(style_of(c, "edp arm2: over"), Style::bad);
  EXPECT_EQ(style_of(c, "mp: process_died"), Style::bad);
}

TEST(Layout, TellsTheBehaviourOfEveryAgentAndWhyTheOneBeforeEnded) {
  View v = drawing();
  ui::AgentView& arm = v.snapshot->agents[1];
  arm.m = 3;
  arm.behaviour = "hold";
  arm.ended_because = "settle: 3 s have passed";
  const Canvas c = lay_out(v, kSmallTerminal);
  EXPECT_EQ(c.text(row_of(c, "arm2") + 1), "          m 3  hold   after settle: 3 s have passed");
  EXPECT_EQ(c.text(row_of(c, "arm1") + 1), "          copy the coordinator's orders");
  arm.ended_because =
      "a behaviour with a long name: its reason is longer than there is room for on the screen";
  const Canvas long_one = lay_out(v, kSmallTerminal);
  const std::string cut = long_one.text(row_of(long_one, "arm2") + 1);
  EXPECT_LE(cut.size(), 80U);
  EXPECT_TRUE(cut.ends_with("its reason is..")) << cut << " is cut within a word";
  for (ui::AgentView& a : v.snapshot->agents) a.behaviour.clear();
  const Canvas without = lay_out(v, kSmallTerminal);
  EXPECT_EQ(without.text(row_of(without, "arm2") + 1).substr(0, 8), " F_z m 3") << without.text();
}

TEST(Layout, TellsWhatTheKeysDoWhenAsked) {
  View v = drawing();
  v.help = true;
  const Canvas c = lay_out(v, {15, 60});
  expect_seen(c, {"t  trigger  ends a behaviour", "Any key goes back", "running", "e E-STOP ? q"});
  EXPECT_EQ(row_of(c, "AGENT"), -1);
}

}  // namespace
}  // namespace mrroc::test
