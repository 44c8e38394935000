// Answers of the operator command server: to every order, in messages, in the record of a run, and about
// scripts.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <thread>

#include "base/fault.hpp"
#include "test/mp/command_server_fixture.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using enum OperatorOrder;

class CommandServerAnswers : public ::testing::Test {
 protected:
  CommandServerAnswers() {
    std::string pattern = (fs::temp_directory_path() / "answers_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~CommandServerAnswers() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string text_of(const std::string& file) const {
    std::ifstream in(folder_ / file);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  fs::path folder_;
};

std::string text_of_answer(CommandServerFixture& fixture, OperatorOrder order) {
  return link::get_text(fixture.order(++fixture.id, static_cast<int>(order)).text);
}

TEST_F(CommandServerAnswers, ARefusalNamesTheStateAndWhatTheOrderNeeds) {
  for (const TaskState state :
       {TaskState::starting, TaskState::waiting_for_start, TaskState::running, TaskState::paused,
        TaskState::stopping, TaskState::ending, TaskState::ended}) {
    const std::string is = "the task is " + std::string(to_string(state));
    const auto said = [&](OperatorOrder order) {
      CommandServerFixture fixture;
      fixture.command_server.set_state(state, false);
      return text_of_answer(fixture, order);
    };
    EXPECT_EQ(said(start), state == TaskState::waiting_for_start ? "start accepted"
                                                                 : is + ", it does not wait for a start");
    EXPECT_EQ(said(pause),
              state == TaskState::running ? "pause accepted" : is + ", only a running one can be paused");
    EXPECT_EQ(said(resume),
              state == TaskState::paused ? "resume accepted" : is + ", only a paused one can be resumed");
    EXPECT_EQ(said(trigger), state == TaskState::running ? "the task does not wait for a trigger"
                                                         : is + ", a trigger needs a running one");
    EXPECT_EQ(said(stop),
              state < TaskState::stopping ? "stop: not every process has confirmed it" : is + " already");
    EXPECT_EQ(said(emergency_stop), state < TaskState::ending ? std::string(to_string(emergency_stop)) +
                                                                    ": not every process has confirmed it"
                                                              : is + " already, and everything rests");
  }
}

TEST_F(CommandServerAnswers, AnOrderThatWaitsForItsMacrostepIsNotTakenTwice) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  for (const OperatorOrder order : {pause, trigger, stop}) {
    EXPECT_TRUE(fixture.accepts(order));
    EXPECT_EQ(text_of_answer(fixture, order), std::string(to_string(order)) + " has just been ordered");
  }
  EXPECT_TRUE(fixture.accepts(emergency_stop));
  EXPECT_EQ(text_of_answer(fixture, emergency_stop), "the emergency stop has been pressed already");
  EXPECT_EQ(link::get_text(fixture.order(77, 6).text), "there is no such order");
  EXPECT_EQ(link::get_text(fixture.order(78, -1).text), "there is no such order");
}

TEST_F(CommandServerAnswers, AnOrderIsPendingUntilItIsInForce) {
  const struct {
    OperatorOrder order;
    TaskState before, after;
  } rows[] = {{start, TaskState::waiting_for_start, TaskState::running},
              {pause, TaskState::running, TaskState::paused},
              {pause, TaskState::running, TaskState::stopping},  // the arms come to rest all the same
              {resume, TaskState::paused, TaskState::running}};
  for (const auto& row : rows) {
    CommandServerFixture fixture;
    fixture.command_server.set_state(row.before, false);
    const auto a = fixture.order(1, static_cast<int>(row.order));
    EXPECT_TRUE(a.accepted);
    EXPECT_TRUE(a.pending) << to_string(row.order);
    std::ignore = fixture.command_server.take(1);
    fixture.command_server.set_state(row.before, true);
    fixture.command_server.settle_stops({}, "all");
    EXPECT_TRUE(fixture.order(1, static_cast<int>(row.order)).pending)
        << "it is asked once more, in the same state";
    fixture.command_server.set_state(row.after, false);
    const auto told = fixture.answers.take();
    ASSERT_TRUE(told) << to_string(row.order);
    EXPECT_EQ(told->id, 1);
    EXPECT_TRUE(told->accepted);
    EXPECT_FALSE(told->pending);
    EXPECT_EQ(link::get_text(told->text), std::string(to_string(row.order)) + " accepted");
    fixture.command_server.set_state(row.before, false);
    EXPECT_FALSE(fixture.answers.take()) << "it is told once";
  }
}

TEST_F(CommandServerAnswers, ATriggerIsAnsweredAtOnce) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  const auto a = fixture.order(1, static_cast<int>(trigger));
  EXPECT_TRUE(a.accepted);
  EXPECT_FALSE(a.pending);
}

TEST_F(CommandServerAnswers, StopsWaitForAllProcessesWhateverTheState) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  EXPECT_TRUE(fixture.order(1, static_cast<int>(pause)).pending);
  EXPECT_FALSE(fixture.command_server.stop_waits());
  EXPECT_TRUE(fixture.order(2, static_cast<int>(stop)).pending);
  EXPECT_TRUE(fixture.command_server.stop_waits());
  fixture.command_server.set_state(TaskState::stopping, false);
  EXPECT_EQ(fixture.answers.take()->id, 1);
  EXPECT_FALSE(fixture.answers.take());
  EXPECT_TRUE(fixture.command_server.stop_waits());
  fixture.command_server.settle_stops({}, "all");
  EXPECT_FALSE(fixture.command_server.stop_waits());
}

TEST_F(CommandServerAnswers, WhatIsRefusedWaitsForNobody) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, true);
  const auto refused = fixture.order(++fixture.id, static_cast<int>(start));
  EXPECT_FALSE(refused.accepted);
  EXPECT_FALSE(refused.pending);
  fixture.command_server.set_state(TaskState::ended, false);
  EXPECT_FALSE(fixture.order(++fixture.id, static_cast<int>(stop)).pending);
  EXPECT_FALSE(fixture.command_server.stop_waits());
}

TEST_F(CommandServerAnswers, AMessageWithoutANumberIsNoOrderOfATerminal) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  operator_order_t m{};
  m.order = static_cast<int>(stop);
  fixture.orders.publish(m, 0);
  fixture.command_server.poll();
  EXPECT_FALSE(fixture.answers.take());
  EXPECT_FALSE(fixture.command_server.stop_accepted());
  EXPECT_FALSE(fixture.command_server.has_terminal());
}

TEST_F(CommandServerAnswers, TheLastSixtyFourAnswersAreRemembered) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_TRUE(fixture.order(1, static_cast<int>(pause)).accepted);
  for (int number = 2; number <= 64; ++number)
    EXPECT_FALSE(fixture.order(number, static_cast<int>(start)).accepted);
  EXPECT_TRUE(fixture.order(1, static_cast<int>(pause)).accepted) << "the same answer, of an order long ago";
  EXPECT_FALSE(fixture.order(65, static_cast<int>(start)).accepted);
  EXPECT_FALSE(fixture.order(1, static_cast<int>(pause)).accepted)
      << "forgotten: it is a new order, and one like it waits";
}

TEST_F(CommandServerAnswers, AStopWhoseAnswerIsForgottenIsSettledAllTheSame) {
  CommandServerFixture fixture;
  fixture.command_server.set_state(TaskState::running, false);
  EXPECT_TRUE(fixture.order(1, static_cast<int>(stop)).pending);
  for (int number = 2; number <= 65; ++number) fixture.order(number, static_cast<int>(start));
  EXPECT_TRUE(fixture.order(66, static_cast<int>(emergency_stop)).pending);
  fixture.command_server.settle_stops({}, "all");
  EXPECT_FALSE(fixture.command_server.stop_waits());
  const auto answer = fixture.answers.take();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->id, 66) << "the other one is told";
  EXPECT_EQ(answer->code, 0);
  EXPECT_FALSE(fixture.answers.take());
}

TEST_F(CommandServerAnswers, AnEmergencyStopIsRepeatedFiftyTimesASecondAtMost) {
  CommandServerFixture fixture;
  link::Queue<operator_order_t> driver(fixture.bus, fixture.process.route("operator"), 1);
  fixture.command_server.set_state(TaskState::running, false);
  fixture.command_server.take(7);
  EXPECT_TRUE(fixture.command_server.give(emergency_stop));
  const auto then = link::Process::Clock::now();
  fixture.command_server.repeat_emergency();
  const auto first = driver.take();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->id, 0);
  EXPECT_EQ(first->header.stamp, 7);
  fixture.command_server.repeat_emergency();
  const bool again = driver.take().has_value();
  if (link::Process::Clock::now() - then < 20ms) {
    EXPECT_FALSE(again);
  }
  std::this_thread::sleep_for(21ms);
  fixture.command_server.repeat_emergency();
  EXPECT_TRUE(driver.take());
}

TEST_F(CommandServerAnswers, WhatIsObeyedIsToldAndRecordedWithItsMacrostep) {
  CommandServerFixture fixture({{9, trigger}}, folder_ / "record");
  OperatorCommandServer& command_server = fixture.command_server;
  command_server.set_state(TaskState::waiting_for_start, false);
  EXPECT_TRUE(command_server.give(start));
  std::ignore = command_server.take(2);
  command_server.set_state(TaskState::running, true);
  std::ignore =
      command_server.take(12);  // of macrosteps that were passed over the script's orders are taken late
  EXPECT_TRUE(command_server.give(stop, "SIGTERM"));
  EXPECT_FALSE(command_server.give(stop, "SIGINT")) << "it waits already";
  EXPECT_TRUE(command_server.take_stop(0)) << "before the first macrostep";
  std::vector<std::string> lines;
  while (const auto line = fixture.lines.take()) {
    lines.push_back(link::get_text(line->text));
    EXPECT_EQ(line->code, 0);
  }
  EXPECT_EQ(lines,
            (std::vector<std::string>{"operator: start in macrostep 2", "operator: trigger in macrostep 12",
                                      "SIGTERM: stop in macrostep 1"}));
  EXPECT_EQ(text_of("record"),
            "# Orders of the operator: macrostep and order. Replay with --script.\n2 start\n12 trigger\n"
            "1 stop  # SIGTERM\n");
}

TEST_F(CommandServerAnswers, AnEmergencyStopOfAScriptIsOfItsOwnMacrostep) {
  CommandServerFixture fixture({{5, emergency_stop}}, folder_ / "record");
  fixture.command_server.set_state(TaskState::running, false);
  std::ignore = fixture.command_server.take(4);
  EXPECT_FALSE(fixture.command_server.emergency());
  std::ignore = fixture.command_server.take(5);
  EXPECT_TRUE(fixture.command_server.emergency());
  EXPECT_TRUE(text_of("record").ends_with("\n5 " + std::string(to_string(emergency_stop)) + "\n"))
      << text_of("record");
  CommandServerFixture skips({{5, emergency_stop}}, folder_ / "other");
  skips.command_server.set_state(TaskState::running, false);
  std::ignore = skips.command_server.take(8);
  EXPECT_TRUE(text_of("other").ends_with("\n8 " + std::string(to_string(emergency_stop)) + "\n"))
      << text_of("other");
}

TEST_F(CommandServerAnswers, ABehaviourThatGoesOnKeepsWhatItWaitsFor) {
  CommandServerFixture fixture;
  OperatorCommandServer& command_server = fixture.command_server;
  command_server.set_behaviour(4);
  command_server.set_state(TaskState::running, true);
  command_server.set_trigger_due(true);
  command_server.set_behaviour(4);
  EXPECT_TRUE(command_server.waits_for_a_person());
  EXPECT_EQ(command_server.needed(), "trigger 1");
  EXPECT_TRUE(command_server.give(trigger));
  std::ignore = command_server.take(3);
  EXPECT_FALSE(command_server.waits_for_a_person()) << "the trigger has been taken";
  EXPECT_EQ(command_server.needed(), "trigger 2");
  command_server.set_trigger_due(true);
  command_server.set_behaviour(5);
  EXPECT_EQ(command_server.needed(), "") << "nobody has said so yet";
  command_server.set_state(TaskState::running, true);
  EXPECT_FALSE(command_server.waits_for_a_person()) << "not due in the new one";
}

TEST_F(CommandServerAnswers, AScriptIsRefusedWithItsFileItsLineAndWhatIsWrong) {
  const auto refusal = [&](const std::string& text) -> std::string {
    std::ofstream(folder_ / "orders") << text;
    try {
      load_script(folder_ / "orders");
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_script);
      return e.what();
    }
    return "";
  };
  const std::string file = (folder_ / "orders").string();
  EXPECT_NE(refusal("5 start\n\nstop\n").find(file + ":3: a line is MACROSTEP ORDER"), std::string::npos);
  EXPECT_NE(refusal("5 begin # now\n")
                .find(file + ":1: '5 begin ' is not an order; the orders are start, pause, resume, trigger, "
                             "stop and e-stop, after a macrostep of at least 1"),
            std::string::npos);
  EXPECT_NE(refusal("0 start\n"), "");
  EXPECT_EQ(refusal("1 start\n"), "");
  EXPECT_EQ(refusal("# " + std::string(1'000'000 - 2, 'x')), "") << "a million characters";
  EXPECT_NE(refusal("# " + std::string(1'000'000 - 1, 'x')), "") << "one more";
  EXPECT_EQ(refusal(" \t\r\n\n   # nothing\n"), "");
}

}  // namespace
}  // namespace mrroc::mp
