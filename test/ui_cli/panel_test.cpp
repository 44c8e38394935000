#include "ui_cli/panel.hpp"

#include <gtest/gtest.h>

#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "test/ui_cli/fake_task.hpp"
#include "ui_cli/keys.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;

class Panel : public ::testing::Test {
 protected:
  void press(int key) {
    panel.key(key, now);
    pass(10ms);
  }
  /// Lets both sides work for that time.
  void pass(std::chrono::milliseconds time) {
    for (const auto end = now + time; now < end; now += 10ms) {
      task.poll();
      client.receive(0ms);
      panel.update(now);
    }
  }
  void publish(TaskState state) {
    task_status_t m = drawing_status();
    m.state = static_cast<std::int32_t>(state);
    task.publish(m);
    pass(10ms);
  }
  /// @return the line above the keys
  std::string notice() { return panel.picture({24, 160}, now).text(22); }
  std::string screen() { return panel.picture({24, 160}, now).text(); }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> task_bus = hub.open();
  std::unique_ptr<link::Bus> bus = hub.open();
  FakeTask task{*task_bus, "s", 7};
  ui::Client client{*bus, {"s", 7, {}, "drawing", "/runs/1", 4711}};
  ui::Clock::time_point now{};
  ui::Panel panel{*bus, client, ui::Glyphs::ascii, now};
};

TEST_F(Panel, GivesTheOrderOfEachKeyAndShowsTheAnswer) {
  for (const auto& [key, order] : {std::pair{'s', OperatorOrder::start},
                                   {'p', OperatorOrder::pause},
                                   {'r', OperatorOrder::resume},
                                   {'t', OperatorOrder::trigger}}) {
    press(key);
    ASSERT_FALSE(task.obeyed.empty()) << key;
    EXPECT_EQ(task.obeyed.back(), order);
    EXPECT_EQ(notice(), std::string(" ").append(to_string(order)).append(" accepted"));
  }
  EXPECT_EQ(task.obeyed.size(), 4U);
}

TEST_F(Panel, HintsNameTheSessionThatTheOperatorHasNamed) {
  ui::Panel named(*bus, client, ui::Glyphs::ascii, now, "s");
  task.refusal_reason = [](OperatorOrder) { return "give `ui_cli start` first"; };
  named.key('r', now);
  for (int k = 0; k < 5; ++k) {
    task.poll();
    client.receive(0ms);
    named.update(now);
  }
  const std::string notice = named.picture({24, 160}, now).text(22);
  EXPECT_EQ(notice, " resume refused: give `ui_cli start --session s` first");
}

TEST_F(Panel, StopsOnlyAfterAYes) {
  press('x');
  EXPECT_NE(notice().find("y/n"), std::string::npos);
  press('n');
  EXPECT_EQ(notice(), " not stopped");
  press('x');
  press('q');
  EXPECT_FALSE(panel.leaving()) << "any key but y means no";
  EXPECT_TRUE(task.obeyed.empty());
  press('y');
  EXPECT_TRUE(task.obeyed.empty()) << "a y without the question means nothing";
  press('x');
  press('y');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::stop});
}

TEST_F(Panel, AKeyThatIsNoCharacterIsNoAnswer) {
  constexpr int kResize = 0632;  // of curses: the screen has another size
  press('x');
  for (const int key : {kResize, ui::key::kUp, ui::key::kLeft}) press(key);
  EXPECT_NE(notice().find("y/n"), std::string::npos);
  press('y');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::stop});
  press('x');
  press(ui::key::kEscape);
  EXPECT_EQ(notice(), " not stopped");
}

TEST_F(Panel, TheEmergencyStopAsksNothingAndPassesEveryQuestionAndEveryOrder) {
  press('e');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::emergency_stop});
  press('x');
  press('e');
  EXPECT_EQ(task.obeyed.size(), 2U) << "also while it asks";
  press('?');
  press('e');
  EXPECT_EQ(task.obeyed.size(), 3U) << "also while the help is open";
  EXPECT_EQ(screen().find("Any key goes back"), std::string::npos);
  press(ui::key::kControlE);
  EXPECT_EQ(task.obeyed, std::vector(4, OperatorOrder::emergency_stop));
  task.deaf = 2;
  press('p');
  press('e');
  pass(300ms);
  EXPECT_EQ(task.obeyed.back(), OperatorOrder::emergency_stop) << "also while an order is not answered";
}

TEST_F(Panel, ChartsShowForcesAndWays) {
  publish(TaskState::running);
  for (const char* name : {"F_x", "F_y", " x ", " y ", " z ", "F_z"}) {
    press('c');
    EXPECT_NE(screen().find(std::string(name)), std::string::npos) << name << screen();
  }
}

TEST_F(Panel, ChartsOfAPlatformShowSpeedsAndWays) {
  task_status_t m = drawing_status();
  for (std::int8_t& effector : m.effector) effector = static_cast<std::int8_t>(EffectorKind::platform);
  task.publish(m);
  pass(10ms);
  for (const char* name : {" w ", " x ", " y ", " v ", " w "}) {
    press('c');
    EXPECT_NE(screen().find(std::string("\n") + name), std::string::npos) << name << screen();
  }
}

TEST_F(Panel, AsksBeforeATriggerThatComesEarly) {
  task_status_t m = drawing_status();
  m.waits_for_trigger = 1;
  link::put_text(m.early, "the hand is still drawing: 33 %");
  task.publish(m);
  pass(10ms);
  press('t');
  EXPECT_EQ(notice(), " the hand is still drawing: 33 %; trigger all the same? y/n");
  press('n');
  EXPECT_EQ(notice(), " not triggered");
  EXPECT_TRUE(task.obeyed.empty());
  press('t');
  press('p');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::pause}) << "another order is a no, and is given";
  task.obeyed.clear();
  press('t');
  press('y');
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::trigger});
}

TEST_F(Panel, AsksAndOrdersNothingWhenTheTaskIsOver) {
  for (const TaskState state : {TaskState::ending, TaskState::ended}) {
    publish(state);
    for (const int key : {int{'x'}, int{'s'}, int{'t'}, int{'e'}}) {
      press(key);
      EXPECT_EQ(notice(), " the task is over; q leaves");
    }
  }
  EXPECT_TRUE(task.heard.empty());
}

TEST_F(Panel, HelpStandsUntilTheNextKeyWhichDoesNothingElseButForTheEmergencyStop) {
  publish(TaskState::running);
  press('?');
  EXPECT_NE(screen().find("Any key goes back"), std::string::npos);
  press('x');
  EXPECT_EQ(screen().find("Any key goes back"), std::string::npos);
  EXPECT_EQ(notice(), "");
}

TEST_F(Panel, ShowsTheReasonOfARefusal) {
  task.refusal_reason = [](OperatorOrder) { return "the task is paused already"; };
  press('p');
  EXPECT_EQ(notice(), " pause refused: the task is paused already");
}

TEST_F(Panel, LeavesWithoutAnOrder) {
  press('q');
  EXPECT_TRUE(panel.leaving());
  EXPECT_TRUE(task.heard.empty());
}

TEST_F(Panel, TakesControlCAsLeaving) {
  press(3);
  EXPECT_TRUE(panel.leaving());
}

TEST_F(Panel, IgnoresOtherKeys) {
  for (const int key : std::initializer_list<int>{0, 27, 'z', 'Q', 410, 1000}) press(key);
  EXPECT_FALSE(panel.leaving());
  EXPECT_TRUE(task.heard.empty());
}

TEST_F(Panel, DoesNotGiveASecondOrderBeforeTheAnswer) {
  task.deaf = 2;
  press('p');
  press('r');
  EXPECT_NE(notice().find("not been answered"), std::string::npos);
  pass(500ms);
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::pause});
}

TEST_F(Panel, StaysAndSaysSoWhenTheTaskDoesNotAnswer) {
  task.deaf = 1000;
  press('p');
  pass(5100ms);
  EXPECT_NE(notice().find("has not answered pause in 5 s; look whether its process 4711"), std::string::npos)
      << notice();
  EXPECT_FALSE(panel.leaving());
}

TEST_F(Panel, FollowsTheTask) {
  publish(TaskState::running);
  EXPECT_NE(screen().find(" running"), std::string::npos);
  publish(TaskState::paused);
  EXPECT_NE(screen().find(" paused"), std::string::npos);
  pass(3s);
  EXPECT_NE(screen().find("NO NEWS FOR 3 s"), std::string::npos);
  publish(TaskState::ended);
  pass(3s);
  EXPECT_EQ(notice(), " the task has ended; its files are in /runs/drawing-1");
}

TEST_F(Panel, ShowsWhatTheProcessesSay) {
  publish(TaskState::running);
  task.say("edp arm1", "motor 2 follows badly", static_cast<std::int32_t>(FaultCode::following_error));
  task.say("nobody", "not of this system");
  pass(10ms);
  EXPECT_NE(screen().find("edp arm1: following_error: motor 2 follows badly"), std::string::npos);
  EXPECT_EQ(screen().find("not of this system"), std::string::npos);
}

TEST_F(Panel, ShowsWhenAMessageWasSaid) {
  task_status_t m = drawing_status();
  m.header.stamp = 100;
  m.sim_time = 2;
  task.publish(m);
  pass(10ms);
  task.say("edp arm1", "of another macrostep", 0, 150);
  task.say("mp", "of none");
  pass(10ms);
  EXPECT_NE(screen().find("     3.00  edp arm1: of another macrostep"), std::string::npos) << screen();
  EXPECT_NE(screen().find("     2.00  mp: of none"), std::string::npos) << screen();
}

TEST_F(Panel, ShowsALineThatCameOverBothWaysOnce) {
  publish(TaskState::running);
  EXPECT_NE(screen().find("the pens are on the paper"), std::string::npos);
  task.say("mp", "the second stroke begins");
  pass(10ms);
  task_status_t m = drawing_status();
  link::put_text(m.last_message, "mp: the second stroke begins");
  task.publish(m);
  pass(10ms);
  const std::string text = screen();
  const auto first = text.find("the second stroke begins");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(text.find("the second stroke begins", first + 1), std::string::npos) << text;
}

TEST_F(Panel, DropsANoticeAfterAWhile) {
  press('p');
  pass(9s);
  EXPECT_EQ(notice(), "");
}

}  // namespace
}  // namespace mrroc::test
