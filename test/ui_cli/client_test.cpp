#include "ui_cli/client.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/effector_command.hpp"
#include "base/link/channel.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"
#include "test/ui_cli/fake_task.hpp"

namespace mrroc::test {
namespace {

using namespace std::chrono_literals;
using ui::Answer;
using ui::Client;

constexpr std::int64_t kId = 77;

/// Task and terminal in one thread, under a clock that the test moves.
class OperatorProtocol : public ::testing::Test {
 protected:
  /// Both sides do what they have to do at this time.
  std::optional<Answer> exchange() {
    auto answer = client.poll(now);
    task.poll();
    client.receive(0ms);
    return answer ? answer : client.poll(now);
  }
  /// @return the answer within that time, looking every 10 ms
  std::optional<Answer> exchange_for(std::chrono::milliseconds time) {
    for (const auto end = now + time; now < end; now += 10ms)
      if (auto answer = exchange()) return answer;
    return std::nullopt;
  }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> task_bus = hub.open();
  std::unique_ptr<link::Bus> client_bus = hub.open();
  FakeTask task{*task_bus, "s", kId};
  Client client{*client_bus, {"s", kId, {}, "drawing", "/runs/1", 4711}};
  ui::Clock::time_point now{};
};

TEST_F(OperatorProtocol, AnswersAnOrderWithWhatWasDone) {
  client.begin(OperatorOrder::pause, now);
  const auto answer = exchange();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->order, OperatorOrder::pause);
  EXPECT_TRUE(answer->accepted);
  EXPECT_EQ(answer->text, "pause accepted");
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::pause});
  EXPECT_FALSE(client.pending());
  EXPECT_FALSE(exchange()) << "an answer is given once";
}

TEST_F(OperatorProtocol, TellsTheReasonOfARefusal) {
  task.refusal_reason = [](OperatorOrder) { return "the task is paused already"; };
  client.begin(OperatorOrder::pause, now);
  const auto answer = exchange();
  ASSERT_TRUE(answer);
  EXPECT_FALSE(answer->accepted);
  EXPECT_EQ(answer->text, "the task is paused already");
  EXPECT_TRUE(task.obeyed.empty());
}

TEST_F(OperatorProtocol, RepeatsAnOrderUntilItIsAnsweredAndNoLonger) {
  task.deaf = 3;
  client.begin(OperatorOrder::trigger, now);
  EXPECT_TRUE(exchange_for(1000ms));
  EXPECT_EQ(now.time_since_epoch(), 300ms) << "one sending every 100 ms";
  EXPECT_FALSE(exchange_for(1000ms));
  EXPECT_EQ(task.heard.size(), 1U);
}

TEST_F(OperatorProtocol, ObeysARepeatedOrderOnce) {
  task.wrong_id = 1;  // the answers get lost
  client.begin(OperatorOrder::trigger, now);
  EXPECT_FALSE(exchange_for(450ms));
  task.wrong_id = 0;
  EXPECT_TRUE(exchange_for(100ms));
  EXPECT_EQ(task.heard.size(), 6U);
  EXPECT_EQ(task.obeyed, std::vector{OperatorOrder::trigger});
  for (std::size_t k = 1; k < task.heard.size(); ++k) {
    EXPECT_EQ(task.heard[k].id, task.heard[0].id);
    EXPECT_GT(task.heard[k].header.number, task.heard[k - 1].header.number)
        << "receivers drop numbers that do not grow";
  }
}

TEST_F(OperatorProtocol, ObeysTheSameOrderAgainWhenItIsGivenAgain) {
  for (int k = 0; k < 3; ++k) {
    client.begin(OperatorOrder::trigger, now);
    EXPECT_TRUE(exchange());
  }
  EXPECT_EQ(task.obeyed.size(), 3U);
}

TEST_F(OperatorProtocol, HearsTheSecondTerminalAsWellAsTheFirst) {
  client.begin(OperatorOrder::pause, now);
  EXPECT_TRUE(exchange());
  const auto other_bus = hub.open();
  Client other(*other_bus, {"s", kId, {}, {}, {}, 0});
  other.begin(OperatorOrder::resume, now);
  other.poll(now);
  task.poll();
  other.receive(0ms);
  client.receive(0ms);
  EXPECT_TRUE(other.poll(now));
  EXPECT_FALSE(client.poll(now)) << "the answer to another terminal is not ours";
}

TEST_F(OperatorProtocol, GivesUpAfterFiveSecondsAndSaysWhatToLookAt) {
  task.deaf = 1000;
  client.begin(OperatorOrder::stop, now);
  EXPECT_FALSE(exchange_for(4990ms));
  now += 10ms;
  try {
    exchange();
    FAIL() << "must give up";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
    EXPECT_EQ(exit_status(e.fault().code), 3);
    EXPECT_EQ(e.error_line(),
              "error: peer_silent: the task of session s has not answered stop in 5 s; look whether its "
              "process 4711 hangs (`ps -p 4711`), and at messages.log in /runs/1");
  }
  EXPECT_FALSE(client.pending());
  EXPECT_FALSE(exchange()) << "it gives up once";
}

/// What a driver says of itself.
void driver_says(link::Bus& bus, const std::string& name, DriverState state, std::int64_t step) {
  link::Outbox<process_status_t> out(bus, {link::Group::agents, "s." + name + ".status"}, kId);
  process_status_t m{};
  m.effector = 1 + static_cast<int>(state);
  m.step = step;
  out.publish(m, 0);
}

TEST_F(OperatorProtocol, AStopThatIsTakenIsWaitedForUntilItIsConfirmed) {
  link::Queue<operator_order_t> orders(*task_bus, {link::Group::agents, "s.operator"}, kId);
  std::int64_t id = 0;
  const auto answers = [&](int pending, int accepted, FaultCode code) {
    while (const auto order = orders.take()) id = order->id;
    operator_answer_t m{};
    m.id = id;
    m.pending = pending;
    m.accepted = accepted;
    m.code = static_cast<int>(code);
    link::put_text(m.text, "what there is to say");
    link::Outbox<operator_answer_t>(*task_bus, {link::Group::agents, "s.answer"}, kId).publish(m, 0);
    client.receive(0ms);
  };
  for (const FaultCode code : {FaultCode::none, FaultCode::stop_not_confirmed}) {
    task.deaf = 1000;
    client.begin(OperatorOrder::stop, now);
    for (int k = 0; k < 20; ++k) {  // longer than it would wait for a task that says nothing
      now += 400ms;
      client.poll(now);
      task.poll();
      answers(1, 1, FaultCode::none);
      EXPECT_FALSE(client.poll(now));
    }
    answers(0, code == FaultCode::none, code);
    const auto answer = client.poll(now);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->accepted, code == FaultCode::none);
    EXPECT_EQ(answer->code, code);
  }
}

TEST_F(OperatorProtocol, OfATaskThatSaysNothingItTellsWhatTheDriversConfirm) {
  task.deaf = 1000;
  client.begin(OperatorOrder::stop, now);
  EXPECT_FALSE(exchange_for(1000ms));
  driver_says(*task_bus, "edp-arm2", DriverState::faulted, 40);
  driver_says(*task_bus, "edp-arm1", DriverState::holding, 40);
  try {
    exchange_for(600ms);
    FAIL() << "the drivers have spoken";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
    EXPECT_EQ(
        e.error_line(),
        "error: peer_silent: stopped: arm1, arm2 at rest; mp does not answer; look whether its process 4711 "
        "hangs (`ps -p 4711`) or is suspended (`kill -CONT 4711` lets it go on), and at messages.log in "
        "/runs/1");
  }
}

TEST_F(OperatorProtocol, AnArmThatMovesIsNoStoppedOne) {
  task.deaf = 1000;
  client.begin(OperatorOrder::stop, now);
  EXPECT_FALSE(exchange_for(1000ms));
  driver_says(*task_bus, "edp-arm1", DriverState::holding, 40);
  driver_says(*task_bus, "edp-arm2", DriverState::executing, 40);
  driver_says(*task_bus, "edp-arm3", DriverState::executing, 40);
  driver_says(*task_bus, "edp-arm3", DriverState::executing, 40);
  driver_says(*task_bus, "edp-arm2", DriverState::executing, 41);
  try {
    exchange_for(5000ms);
    FAIL() << "must give up";
  } catch (const FaultError& e) {
    EXPECT_EQ(now.time_since_epoch(), 5000ms) << "it is waited for";
    EXPECT_NE(
        std::string(e.what()).find("has not answered stop in 5 s; arm1 at rest; arm2 moves (executing); arm3 "
                                   "stands still, because simulated time does"),
        std::string::npos)
        << e.what();
  }
}

TEST_F(OperatorProtocol, IgnoresAnswersAndStatusOfAnotherSessionId) {
  const auto stranger_bus = hub.open();
  FakeTask stranger(*stranger_bus, "s", kId + 1);
  stranger.publish(drawing_status());
  client.receive(0ms);
  EXPECT_FALSE(client.status());
  task.wrong_session = 1;
  client.begin(OperatorOrder::pause, now);
  EXPECT_FALSE(exchange_for(300ms));
  task.wrong_session = 0;
  EXPECT_TRUE(exchange_for(100ms));
}

TEST_F(OperatorProtocol, LearnsTheSessionIdFromTheFirstStatusWhenItIsNotKnown) {
  const auto other_bus = hub.open();
  Client other(*other_bus, {"s", 0, {}, {}, {}, 0});
  other.begin(OperatorOrder::pause, now);
  other.poll(now);
  task.poll();
  EXPECT_TRUE(task.heard.empty()) << "nobody may be meant yet";
  task.publish(drawing_status());
  other.receive(0ms);
  now += 100ms;
  other.poll(now);
  task.poll();
  other.receive(0ms);
  EXPECT_TRUE(other.poll(now));
}

TEST_F(OperatorProtocol, ShowsTheNewestStatusWhateverOrderTheyComeIn) {
  EXPECT_FALSE(client.status());
  task_status_t status = drawing_status();
  for (int m = 1; m <= 3; ++m) {
    status.m = m;
    task.publish(status);
  }
  client.receive(0ms);
  EXPECT_EQ(client.news(), 3);
  EXPECT_EQ(client.status()->m, 3);
  EXPECT_EQ(client.status()->session, "s");
}

TEST_F(OperatorProtocol, GivesUpWaitingForAStatus) {
  Client hasty(*client_bus, {"quiet", 0, {}, {}, {}, 0}, {.repeat = 1ms, .give_up = 20ms});
  try {
    hasty.await_status();
    FAIL() << "must give up";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
  }
}

TEST(Snapshot, TakesOverWhatTheTaskTold) {
  const ui::Snapshot s = ui::snapshot(drawing_status(), "s");
  EXPECT_EQ(s.task, "drawing");
  EXPECT_EQ(s.state, TaskState::running);
  EXPECT_EQ(s.m, 5);
  EXPECT_EQ(s.behaviour, "draw on the paper");
  EXPECT_EQ(s.macrostep, 617);
  EXPECT_EQ(s.progress, 0.63);
  ASSERT_EQ(s.agents.size(), 2U);
  EXPECT_EQ(s.agents[1].T_0E[1], -0.25);
  EXPECT_EQ(s.agents[0].F_a[2], 1.02);
  EXPECT_EQ(s.agents[0].sensor, "paper_surface");
  EXPECT_EQ(s.agents[1].behaviour, "copy the coordinator's orders");
  ASSERT_EQ(s.processes.size(), 8U);
  EXPECT_EQ(s.processes[2].name, "edp arm1");
  EXPECT_EQ(s.processes[2].state, link::ProcessState::running);
  EXPECT_EQ(s.last_code, FaultCode::none);
  EXPECT_EQ(s.run_folder, "/runs/drawing-1");
}

TEST(Snapshot, HasAProgressOnlyWhenTheTaskKnowsIt) {
  task_status_t m = drawing_status();
  m.progress = -1;
  EXPECT_FALSE(ui::snapshot(m, "s").progress);
  m.progress = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(ui::snapshot(m, "s").progress);
  m.progress = 1e9;
  EXPECT_EQ(ui::snapshot(m, "s").progress, 1.0);
}

TEST(Snapshot, SurvivesAnyBytes) {
  std::mt19937_64 random(1);
  std::uniform_int_distribution<int> byte(0, 255);
  for (int round = 0; round < 2000; ++round) {
    task_status_t m{};
    const auto raw = std::as_writable_bytes(std::span(&m, 1));
    for (auto& b : raw) b = static_cast<std::byte>(byte(random));
    const ui::Snapshot s = ui::snapshot(m, "s");
    EXPECT_LE(s.agents.size(), 4U);
    EXPECT_LE(s.processes.size(), 16U);
    EXPECT_FALSE(to_string(s.state).empty());
    for (const ui::ProcessView& p : s.processes) {
      EXPECT_FALSE(link::to_string(p.state).empty());
      for (const char c : p.name) EXPECT_FALSE(static_cast<unsigned char>(c) < ' ' || c == 0x7f);
    }
  }
}

}  // namespace
}  // namespace mrroc::test
