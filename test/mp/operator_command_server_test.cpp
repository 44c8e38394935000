// The operator's orders: refused with a reason, obeyed once.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "test/mp/command_server_fixture.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using enum OperatorOrder;

TEST_F(CommandServer, AcceptsInEachStateWhatMakesSense) {
  struct Row {
    TaskState state;
    bool waits;
    std::vector<OperatorOrder> accepted;
  };
  const std::vector<Row> table{{TaskState::starting, false, {stop, emergency_stop}},
                               {TaskState::waiting_for_start, false, {start, stop, emergency_stop}},
                               {TaskState::running, false, {pause, stop, emergency_stop}},
                               {TaskState::running, true, {pause, trigger, stop, emergency_stop}},
                               {TaskState::paused, false, {resume, stop, emergency_stop}},
                               {TaskState::paused, true, {resume, stop, emergency_stop}},
                               {TaskState::stopping, true, {emergency_stop}},
                               {TaskState::ending, true, {}},
                               {TaskState::ended, true, {}}};
  for (const Row& row : table)
    for (const OperatorOrder o : kOperatorOrders) {
      CommandServerFixture fixture;
      fixture.command_server.set_state(row.state, row.waits);
      const bool expected = std::ranges::find(row.accepted, o) != row.accepted.end();
      EXPECT_EQ(fixture.accepts(o), expected) << to_string(o) << " while " << to_string(row.state);
    }
}

TEST_F(CommandServer, NamesTheOrderThatTheStateNeeds) {
  CommandServerFixture fixture({{.i = 5, .order = start}, {.i = 9, .order = trigger}}, {});
  OperatorCommandServer& command_server = fixture.command_server;
  EXPECT_EQ(command_server.needed(), "");
  command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_EQ(command_server.needed(), "start");
  EXPECT_EQ(command_server.next_in_script(), 5);
  std::ignore = command_server.take(5);
  EXPECT_EQ(command_server.needed(), "") << "it has been given";
  command_server.set_state(TaskState::running, true);
  EXPECT_EQ(command_server.needed(), "trigger 1");
  EXPECT_EQ(command_server.next_in_script(), 9);
  std::ignore = command_server.take(9);
  EXPECT_EQ(command_server.needed(), "trigger 2");
  EXPECT_EQ(command_server.next_in_script(), std::nullopt) << "it has ended";
  EXPECT_FALSE(command_server.has_terminal());
  EXPECT_TRUE(fixture.accepts(pause));
  EXPECT_TRUE(command_server.has_terminal());
  std::ignore = command_server.take(10);
  command_server.set_state(TaskState::paused, true);
  EXPECT_EQ(command_server.needed(), "resume");
}

TEST_F(CommandServer, ARefusalSaysWhyAndChangesNothing) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  const auto a = fixture.order(7, static_cast<int>(trigger));
  EXPECT_FALSE(a.accepted);
  EXPECT_EQ(link::get_text(a.text), "the task does not wait for a trigger");
  const OperatorImage image = fixture.command_server.take(5);
  EXPECT_EQ(image.trigger, 0);
  EXPECT_FALSE(image.paused);
}

TEST_F(CommandServer, AnOrderThatDoesNotExistIsRefused) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  for (const int number : {-1, 6, 1000, INT32_MIN, INT32_MAX})
    EXPECT_FALSE(fixture.order(100 + number % 50, number).accepted) << number;
}

TEST_F(CommandServer, ARepeatedOrderIsAnsweredAgainAndObeyedOnce) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(fixture.order(7, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(fixture.command_server.take(10).trigger, 1);
  for (int k = 0; k < 5; ++k) EXPECT_TRUE(fixture.order(7, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(fixture.command_server.take(11).trigger, 1);
  EXPECT_TRUE(fixture.order(8, static_cast<int>(trigger)).accepted);
  EXPECT_EQ(fixture.command_server.take(12).trigger, 2);
}

TEST_F(CommandServer, TheSameOrderTwiceInAMacrostepIsOneOrder) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_TRUE(fixture.accepts(trigger));
  EXPECT_FALSE(fixture.accepts(trigger));
  fixture.command_server.give(trigger);
  EXPECT_EQ(fixture.command_server.take(10).trigger, 1);
}

TEST_F(CommandServer, ASecondTriggerDoesNotEndTheNextBehaviour) {
  CommandServerFixture fixture;
  fixture.command_server.set_behaviour(2);
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_TRUE(fixture.accepts(trigger));
  EXPECT_EQ(fixture.command_server.take(10).trigger, 1);
  fixture.command_server.set_behaviour(3);  // its entry has noted trigger 1
  const auto a = fixture.order(77, static_cast<int>(trigger));
  EXPECT_FALSE(a.accepted);
  EXPECT_EQ(link::get_text(a.text), "behaviour 3 does not wait for a trigger");
  EXPECT_FALSE(fixture.command_server.give(trigger));
  EXPECT_EQ(fixture.command_server.take(11).trigger, 1);
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_TRUE(fixture.accepts(trigger));
  EXPECT_EQ(fixture.command_server.take(12).trigger, 2);
}

TEST_F(CommandServer, ATriggerForABehaviourThatHasEndedIsDropped) {
  CommandServerFixture fixture;
  fixture.command_server.set_behaviour(2);
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_TRUE(fixture.accepts(trigger));
  EXPECT_TRUE(fixture.accepts(pause));
  fixture.command_server.set_behaviour(2);  // still
  fixture.command_server.set_behaviour(3);  // ended by something else
  const OperatorImage image = fixture.command_server.take(11);
  EXPECT_EQ(image.trigger, 0);
  EXPECT_TRUE(image.paused) << "what is not for a behaviour stays";
  const auto line = fixture.lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(link::get_text(line->text),
            "operator: the trigger came when behaviour 2 had ended, it is not obeyed");
}

TEST_F(CommandServer, OrdersOfAnotherSessionAreNotHeard) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  link::Outbox<operator_order_t> stranger(fixture.bus, fixture.process.route("operator"), 999);
  operator_order_t m{};
  m.order = static_cast<int>(stop);
  stranger.publish(m, 0);
  fixture.command_server.poll();
  fixture.command_server.take(1);
  EXPECT_FALSE(fixture.command_server.stop_ordered());
  EXPECT_FALSE(fixture.answers.take());
}

TEST_F(CommandServer, OrdersTakeEffectInTheMacrostepInWhichTheyAreTaken) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(fixture.accepts(start));
  EXPECT_TRUE(fixture.command_server.take(3).started);
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_TRUE(fixture.accepts(pause));
  EXPECT_TRUE(fixture.command_server.take(4).paused);
  fixture.command_server.set_state(TaskState::paused, false);
  EXPECT_TRUE(fixture.accepts(resume));
  EXPECT_FALSE(fixture.command_server.take(5).paused);
  EXPECT_TRUE(fixture.accepts(stop));
  EXPECT_FALSE(fixture.command_server.stop_ordered());
  fixture.command_server.take(6);
  EXPECT_TRUE(fixture.command_server.stop_ordered());
}

TEST_F(CommandServer, EachOrderHasItsOwnEffectAndNoOther) {
  for (const OperatorOrder o : kOperatorOrders)
    for (const bool paused : {false, true}) {
      CommandServerFixture fixture;
      OperatorCommandServer& server = fixture.command_server;
      server.set_state(TaskState::running, true);
      if (paused) {
        ASSERT_TRUE(server.give(pause));
        ASSERT_TRUE(server.take(4).paused);
      }
      server.set_state(o == start ? TaskState::waiting_for_start
                       : paused   ? TaskState::paused
                                  : TaskState::running,
                       true);
      if (!server.give(o)) continue;
      const OperatorImage image = server.take(5);
      EXPECT_EQ(image.started, o == start) << to_string(o);
      EXPECT_EQ(image.paused, o == pause || (paused && o != resume)) << to_string(o);
      EXPECT_EQ(image.trigger, o == trigger ? 1 : 0) << to_string(o);
      EXPECT_EQ(server.stop_ordered(), o == stop) << to_string(o);
      EXPECT_EQ(server.stop_accepted(), o == stop) << to_string(o);
      EXPECT_EQ(server.emergency(), o == emergency_stop) << to_string(o);
    }
}

TEST_F(CommandServer, KnowsWhenOnlyAPersonCanGoOn) {
  CommandServerFixture fixture;
  EXPECT_FALSE(fixture.command_server.waits_for_a_person()) << "the task is starting by itself";
  fixture.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(fixture.command_server.waits_for_a_person());
  EXPECT_TRUE(fixture.command_server.give(start));
  EXPECT_FALSE(fixture.command_server.waits_for_a_person()) << "the order waits for its macrostep";
  std::ignore = fixture.command_server.take(5);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person())
      << "it has been started, whatever the arms still have to do";
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person());
  EXPECT_TRUE(fixture.command_server.give(pause));
  std::ignore = fixture.command_server.take(6);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person()) << "the arms have not come to rest yet";
  fixture.command_server.set_state(TaskState::paused, false);
  EXPECT_TRUE(fixture.command_server.waits_for_a_person());
  EXPECT_TRUE(fixture.command_server.give(resume));
  EXPECT_FALSE(fixture.command_server.waits_for_a_person());
  std::ignore = fixture.command_server.take(7);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person());
  for (const TaskState state :
       {TaskState::starting, TaskState::running, TaskState::stopping, TaskState::ending, TaskState::ended}) {
    fixture.command_server.set_state(state, false);
    EXPECT_FALSE(fixture.command_server.waits_for_a_person()) << to_string(state);
  }
  fixture.command_server.set_behaviour(4);
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person()) << "the trigger would come early";
  fixture.command_server.set_trigger_due(true);
  EXPECT_TRUE(fixture.command_server.waits_for_a_person());
  fixture.command_server.set_state(TaskState::paused, true);
  EXPECT_FALSE(fixture.command_server.waits_for_a_person());
  CommandServerFixture hurt;
  hurt.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(hurt.command_server.give(emergency_stop));
  EXPECT_FALSE(hurt.command_server.waits_for_a_person());
  CommandServerFixture stopped;
  stopped.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(stopped.command_server.give(stop));
  EXPECT_FALSE(stopped.command_server.waits_for_a_person());
  CommandServerFixture scripted({{100, start}});
  scripted.command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_FALSE(scripted.command_server.waits_for_a_person()) << "the script gives the start in macrostep 100";
}

}  // namespace
}  // namespace mrroc::mp
