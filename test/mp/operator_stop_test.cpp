// The operator's stops: answered when they are confirmed, taken as early as they can be.
#include <gtest/gtest.h>

#include "base/fault.hpp"
#include "test/mp/command_server_fixture.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using enum OperatorOrder;

TEST_F(CommandServer, AStopIsAcceptedWhenEverybodyHasConfirmedItAndNotBefore) {
  for (const OperatorOrder order : {stop, emergency_stop}) {
    CommandServerFixture fixture;
    fixture.command_server.set_state(TaskState::running, false);
    const auto taken = fixture.order(7, static_cast<int>(order));
    EXPECT_TRUE(taken.pending);
    EXPECT_TRUE(fixture.command_server.stop_waits());
    EXPECT_TRUE(fixture.order(7, static_cast<int>(order)).pending) << "asked again, it has the same answer";
    fixture.command_server.settle_stops({}, "every process has confirmed it");
    EXPECT_FALSE(fixture.command_server.stop_waits());
    const auto answer = fixture.answers.take();
    ASSERT_TRUE(answer) << "without being asked again";
    EXPECT_EQ(answer->id, 7);
    EXPECT_TRUE(answer->accepted);
    EXPECT_FALSE(answer->pending);
    EXPECT_EQ(link::get_text(answer->text),
              std::string(to_string(order)) + " accepted: every process has confirmed it");
    EXPECT_FALSE(fixture.order(7, static_cast<int>(order)).pending);
  }
}

TEST_F(CommandServer, AStopThatSomebodyDoesNotConfirmIsNotAccepted) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  fixture.order(7, static_cast<int>(stop));
  fixture.command_server.settle_stops(
      {.code = FaultCode::stop_not_confirmed, .text = "not confirmed by edp-arm1"}, {});
  const auto answer = fixture.answers.take();
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->accepted);
  EXPECT_FALSE(answer->pending);
  EXPECT_EQ(answer->code, static_cast<int>(FaultCode::stop_not_confirmed));
  EXPECT_EQ(link::get_text(answer->text), "stop: not confirmed by edp-arm1");
}

TEST_F(CommandServer, AStopIsKnownBeforeItIsTaken) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_FALSE(fixture.command_server.stop_accepted());
  EXPECT_TRUE(fixture.accepts(stop));
  EXPECT_TRUE(fixture.command_server.stop_accepted());
  EXPECT_FALSE(fixture.command_server.stop_ordered());
  fixture.command_server.take(1);
  EXPECT_TRUE(fixture.command_server.stop_accepted());
}

TEST_F(CommandServer, AStopIsTakenBetweenMacrostepsAndRecordedAsTheScriptThatGivesTheSame) {
  CommandServerFixture fixture({}, folder_ / "record");
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_FALSE(fixture.command_server.take_stop(7)) << "nobody has ordered it";
  EXPECT_TRUE(fixture.accepts(pause));
  EXPECT_TRUE(fixture.accepts(stop));
  EXPECT_TRUE(fixture.command_server.take_stop(7));
  EXPECT_TRUE(fixture.command_server.stop_ordered());
  EXPECT_FALSE(fixture.command_server.take_stop(8)) << "once";
  EXPECT_TRUE(fixture.command_server.take(9).paused) << "other orders wait for their macrostep";
  const auto script = load_script(folder_ / "record");
  ASSERT_EQ(script.size(), 2U);
  EXPECT_EQ(script[0].i, 7);
  EXPECT_EQ(script[0].order, stop);
}

TEST_F(CommandServer, AStopByASignalIsNotToldToBeTheOperators) {
  for (const bool by_signal : {true, false}) {
    const fs::path record = folder_ / (by_signal ? "signal" : "operator");
    CommandServerFixture fixture({}, record);
    fixture.command_server.set_state(TaskState::running, false);
    if (by_signal)
      EXPECT_TRUE(fixture.command_server.give(stop, "SIGTERM"));
    else
      EXPECT_TRUE(fixture.accepts(stop));
    fixture.command_server.take(12);
    const auto line = fixture.lines.take();
    ASSERT_TRUE(line);
    EXPECT_EQ(link::get_text(line->text),
              by_signal ? "SIGTERM: stop in macrostep 12" : "operator: stop in macrostep 12");
    const auto again = load_script(record);  // it can be replayed
    ASSERT_EQ(again.size(), 1U);
    EXPECT_EQ(again[0].i, 12);
    EXPECT_EQ(again[0].order, stop);
  }
}

TEST_F(CommandServer, AnEmergencyStopWaitsForNoMacrostepAndReachesTheDriversAgainAndAgain) {
  const fs::path record = folder_ / "record";
  CommandServerFixture fixture({}, record);
  link::Queue<operator_order_t> driver(fixture.bus, fixture.process.route("operator"),
                                       fixture.process.context().session_id);
  fixture.command_server.set_state(TaskState::running, false);
  fixture.command_server.take(41);
  fixture.command_server.repeat_emergency();
  EXPECT_FALSE(driver.take()) << "nobody has pressed it";
  EXPECT_TRUE(fixture.accepts(emergency_stop));
  EXPECT_TRUE(fixture.command_server.emergency()) << "at once";
  EXPECT_TRUE(driver.take()) << "the terminal's own message";
  fixture.command_server.repeat_emergency();
  const auto repeated = driver.take();
  ASSERT_TRUE(repeated);
  EXPECT_EQ(repeated->order, static_cast<int>(emergency_stop));
  fixture.command_server.poll();
  EXPECT_FALSE(fixture.answers.take()) << "MP does not answer itself";
  EXPECT_FALSE(fixture.accepts(emergency_stop));
  const auto script = load_script(record);
  ASSERT_EQ(script.size(), 1U);
  EXPECT_EQ(script[0].i, 42);
  CommandServerFixture again(script);
  again.command_server.set_state(TaskState::running, false);
  again.command_server.take(41);
  EXPECT_FALSE(again.command_server.emergency());
  again.command_server.take(42);
  EXPECT_TRUE(again.command_server.emergency()) << "the script replays it";
}

}  // namespace
}  // namespace mrroc::mp
