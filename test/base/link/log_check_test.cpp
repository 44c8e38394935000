// A process that is recomputed from the log of its run: nothing differs, and what has been changed is named.
#include "base/link/log_check.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <deque>

#include "base/link/event_log.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/replay_bus.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/message_type.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/operator_order_t.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

template <FixedMessage M>
Bytes bytes_of(const M& m) {
  Bytes bytes(static_cast<std::size_t>(encoded_size<M>()));
  m.encode(bytes.data(), 0, encoded_size<M>());
  return bytes;
}

/// Gives a process its messages one by one and writes down everything, as a run does.
class RecordedBus final : public Bus {
 public:
  explicit RecordedBus(const fs::path& log) : log_(log, 77) {}
  void say(const std::string& channel, const Bytes& bytes) { coming_.emplace_back("s." + channel, bytes); }
  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    log_.receive(route.channel, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override { sinks_[route.channel].push_back(&sink); }
  void subscribe_all(const std::string&, Sink&) override {}
  bool wait(std::chrono::milliseconds) override {
    if (coming_.empty()) return false;
    const auto [channel, bytes] = coming_.front();
    coming_.pop_front();
    log_.receive(channel, bytes);
    for (Sink* s : sinks_[channel]) s->receive(channel, bytes);
    return true;
  }

 private:
  EventLog log_;
  std::deque<std::pair<std::string, Bytes>> coming_;
  std::map<std::string, std::vector<Sink*>> sinks_;
};

constexpr std::int64_t kMacrosteps = 30;

/// An agent of two behaviours: it counts and holds. @param gain  part of its f'
void agent(Process& process, double gain) {
  const auto in = process.inbox<agent_report_t>("arm1.report");
  const auto out = process.outbox<agent_order_t>("arm1.order");
  if (!process.assemble()) return;
  const Sources sources{in.get()};
  double memory = 0;
  for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
    process.await_from(sources, FaultCode::peer_silent, [&] { return in->at(i) != nullptr; });
    const Report r = from_message(*in->at(i));
    memory += r.F_a[Axis::z];
    const bool far = memory > 40;
    process.in_behaviour(far ? 2 : 1, far ? "hold" : "count");
    Order o{.m = far ? 2 : 1};
    o.arm.frame.z.velocity = far ? 0 : gain * memory;
    out->publish(to_message(o), i + 1);
  }
}

class LogCheck : public ::testing::Test {
 protected:
  LogCheck() {
    std::string pattern = (fs::temp_directory_path() / "log_check_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    record();
  }
  ~LogCheck() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file() const { return folder_ / kEventLog; }

  void record() {
    RecordedBus bus(file());
    supervisor_t running{};
    running.header = {77, 1, 0};
    running.phase = static_cast<int>(Phase::running);
    bus.say("supervisor", bytes_of(running));
    for (std::int64_t i = 1; i <= kMacrosteps; ++i) {
      Report r{.m = 3};
      r.F_a[Axis::z] = 0.1 * static_cast<double>(i);
      agent_report_t m = to_message(r);
      m.header = {77, i, i};
      bus.say("arm1.report", bytes_of(m));
    }
    Process process(bus, {.session = "s", .session_id = 77, .name = "mp", .roster = {"mp"}});
    agent(process, 2);
  }

  /// Writes the log anew. @param change  gets every message; false: it is left out
  void rewrite(const std::function<bool(LoggedMessage&)>& change) {
    const LogReader before(file());
    EventLog log(file(), before.session_id());
    for (LoggedMessage m : before.messages())
      if (change(m)) log.receive(before.session() + "." + m.channel, m.bytes);
  }

  [[nodiscard]] LogVerdict check(double gain = 2, ClockKind clock = ClockKind::step) const {
    return check_process(LogReader(file()), "mp", clock, [&](Process& p) { agent(p, gain); });
  }

  fs::path folder_;
};

TEST_F(LogCheck, TheSameProgramSendsTheSameAgain) {
  const LogVerdict v = check();
  EXPECT_EQ(v.compared, kMacrosteps);
  EXPECT_EQ(v.differences, 0);
  EXPECT_FALSE(v.first);
  EXPECT_EQ(v.incomplete, "");
  EXPECT_EQ(v.not_checked, "");
}

TEST_F(LogCheck, AChangedFieldIsNamedWithBothValues) {
  const MessageType& type = *type_of(bytes_of(agent_order_t{}));
  const Field& velocity = *type.field("arm.axis[2].velocity");
  rewrite([&](LoggedMessage& m) {
    if (m.channel == "arm1.order" && header_of(m.bytes).number == 7) m.bytes[velocity.offset + 2] ^= 1;
    return true;
  });
  const LogVerdict v = check();
  EXPECT_EQ(v.differences, 1);
  ASSERT_TRUE(v.first);
  EXPECT_EQ(v.first->channel, "arm1.order");
  EXPECT_EQ(v.first->number, 7);
  EXPECT_EQ(v.first->stamp, 8);
  EXPECT_EQ(v.first->field, "arm.axis[2].velocity");
  EXPECT_EQ(v.first->function, "f_cT");
  EXPECT_EQ(v.first->behaviour, "1, count");
  EXPECT_NE(v.first->logged, v.first->recomputed);
}

TEST_F(LogCheck, ChangedFunctionsDifferInTheirFirstMacrostepAndMemoryGoesOnFromTheBeginning) {
  const LogVerdict v = check(2.5);
  ASSERT_TRUE(v.first);
  EXPECT_EQ(v.first->stamp, 2);
  EXPECT_EQ(v.first->behaviour, "1, count");
  EXPECT_EQ(v.first->logged, "0.2");
  EXPECT_EQ(v.first->recomputed, "0.25");
  EXPECT_LT(v.differences, kMacrosteps) << "the second behaviour does not use the gain";
  EXPECT_GT(v.differences, kMacrosteps / 2);
}

TEST_F(LogCheck, ABehaviourThatEndsElsewhereIsATerminalCondition) {
  const Field& Fz = *type_of(bytes_of(agent_report_t{}))->field("F_a[2]");
  rewrite([&](LoggedMessage& m) {
    // A large force that the run has not seen: the agent goes over to the other behaviour at once.
    if (m.channel == "arm1.report" && header_of(m.bytes).stamp == 5) m.bytes[Fz.offset] = 0x41;
    return true;
  });
  const LogVerdict v = check();
  ASSERT_TRUE(v.first);
  EXPECT_EQ(v.first->stamp, 6);
  EXPECT_EQ(v.first->field, "m");
  EXPECT_EQ(v.first->function, "f_tau");
  EXPECT_EQ(v.first->behaviour, "2, hold");
}

TEST_F(LogCheck, WhatTheLogLacksIsSaidAndNotTakenForADifference) {
  rewrite([](LoggedMessage& m) { return m.channel != "arm1.report" || header_of(m.bytes).number != 10; });
  const LogVerdict v = check();
  EXPECT_EQ(v.compared, 9);
  EXPECT_EQ(v.differences, 0);
  EXPECT_EQ(v.incomplete, "the log lacks arm1.report, number 10");
}

TEST_F(LogCheck, WhatIsNotSentAgainDiffers) {
  const LogVerdict v = check_process(LogReader(file()), "mp", ClockKind::step, [](Process& process) {
    const auto out = process.outbox<agent_order_t>("arm1.order");
    if (process.assemble()) throw FaultError(FaultCode::internal_error, "gives up");
  });
  EXPECT_EQ(v.differences, kMacrosteps);
  ASSERT_TRUE(v.first);
  EXPECT_EQ(v.first->channel, "arm1.order");
  EXPECT_EQ(v.first->number, 1);
  EXPECT_EQ(v.first->logged, "a message");
  EXPECT_EQ(v.first->recomputed, "nothing");
}

// When a process heard of a stop at once is not in the log: what it had sent until then tells how far it came.
TEST_F(LogCheck, WithoutAJudgeNothingIsComparedAndNothingMissing) {
  const LogReader log(file());
  ReplayBus bus(log);
  while (true) {
    try {
      bus.wait(std::chrono::milliseconds(1));
    } catch (const LogEnded&) {
      break;
    }
  }
  EXPECT_TRUE(bus.not_sent().empty());
  EXPECT_EQ(bus.compared(), 0);
}

TEST_F(LogCheck, AStopAtOnceIsHeardWhenAllElseHasBeen) {
  for (const std::int64_t as_of : {0, 12}) {
    record();
    {
      const LogReader before(file());
      EventLog log(file(), before.session_id());
      int written = 0;
      for (const LoggedMessage& m : before.messages()) {
        log.receive("s." + m.channel, m.bytes);
        if (++written != 12) continue;
        supervisor_t stopping{};
        stopping.header = {77, 2, 0};
        stopping.phase = static_cast<int>(Phase::stopping);
        stopping.as_of = as_of;
        log.receive("s.supervisor", bytes_of(stopping));
      }
    }
    bool stopped = false;
    const LogVerdict v = check_process(LogReader(file()), "mp", ClockKind::step, [&](Process& process) {
      const auto in = process.inbox<agent_report_t>("arm1.report");
      const auto out = process.outbox<agent_order_t>("arm1.order");
      if (!process.assemble()) return;
      double memory = 0;
      for (std::int64_t i = 1; i <= kMacrosteps + 1; ++i) {
        process.await([&] { return in->at(i) != nullptr || process.over(); });
        if ((stopped = process.over())) return;
        memory += from_message(*in->at(i)).F_a[Axis::z];
        const bool far = memory > 40;
        Order o{.m = far ? 2 : 1};
        o.arm.frame.z.velocity = far ? 0 : 2 * memory;
        out->publish(to_message(o), i + 1);
      }
    });
    EXPECT_TRUE(stopped);
    if (as_of == 0) {
      EXPECT_EQ(v.compared, kMacrosteps);
      EXPECT_EQ(v.differences, 0);
    } else {
      EXPECT_LT(v.compared, kMacrosteps) << "an agreed one when it came";
    }
  }
}

TEST_F(LogCheck, MessagesOfAnotherVersionAreNoMessages) {
  rewrite([](LoggedMessage& m) {
    if (m.channel == "arm1.report") m.bytes[0] ^= 1;  // of its fingerprint
    return true;
  });
  const LogVerdict v = check();
  EXPECT_EQ(v.compared, 0);
  EXPECT_EQ(v.differences, 0);
  EXPECT_EQ(v.incomplete, "the log lacks arm1.report as this version of the framework has it");
}

TEST_F(LogCheck, AChannelMayBeLeftOutAsIfNobodyHadSpokenThere) {
  const LogVerdict v = check_process(LogReader(file()), "mp", ClockKind::step,
                                     [](Process& p) { agent(p, 2); }, {"arm1.report"});
  EXPECT_EQ(v.compared, 0);
  EXPECT_EQ(v.process, "mp");
}

TEST_F(LogCheck, TheVerdictsStatusTellsOfDifferences) {
  ::testing::internal::CaptureStdout();
  EXPECT_EQ(report_verdict(check()), 0);
  EXPECT_EQ(report_verdict(check(2.5)), 1);
  const std::string out = ::testing::internal::GetCapturedStdout();
  EXPECT_EQ(out, to_json(check()) + "\n" + to_json(check(2.5)) + "\n");
}

TEST_F(LogCheck, ATerminalThatNumbersItsOrdersItselfHidesNoDifference) {
  {
    const LogReader before(file());
    EventLog log(file(), before.session_id());
    operator_order_t order{};
    order.header = {77, 1'760'000'000, 0};
    log.receive("s.operator", bytes_of(order));
    for (const LoggedMessage& m : before.messages()) log.receive("s." + m.channel, m.bytes);
  }
  const LogVerdict v = check_process(LogReader(file()), "mp", ClockKind::step, [](Process& process) {
    const auto in = process.inbox<operator_order_t>("operator");
    const auto out = process.outbox<agent_order_t>("arm1.order");
    if (process.assemble()) throw FaultError(FaultCode::internal_error, "gives up");
  });
  EXPECT_EQ(v.incomplete, "");
  EXPECT_EQ(v.differences, kMacrosteps);
}

TEST_F(LogCheck, AProcessBeyondTheLogIsNotChecked) {
  EXPECT_NE(check(2, ClockKind::wall).not_checked.find("wall clock"), std::string::npos);
  const LogVerdict v = check_process(LogReader(file()), "edp", ClockKind::step, [](Process& process) {
    process.inbox<agent_order_t>("drive", Group::servo_state);
  });
  EXPECT_EQ(v.not_checked, "the servo links are not in the log");
  const LogVerdict w = check_process(LogReader(file()), "edp", ClockKind::step, [](Process& process) {
    process.outbox<agent_order_t>("drive", Group::servo_command);
  });
  EXPECT_EQ(w.not_checked, "the servo links are not in the log");
}

TEST_F(LogCheck, WhatIsNotSentAgainAfterADifferenceComesSecond) {
  rewrite([](LoggedMessage& m) {
    if (m.channel == "arm1.order" && header_of(m.bytes).number == 2) m.bytes.back() ^= 1;
    return true;
  });
  const LogVerdict v = check_process(LogReader(file()), "mp", ClockKind::step, [](Process& process) {
    const auto in = process.inbox<agent_report_t>("arm1.report");
    const auto out = process.outbox<agent_order_t>("arm1.order");
    if (!process.assemble()) return;
    process.in_behaviour(1, "count");
    double memory = 0;
    for (std::int64_t i = 1; i <= 3; ++i) {
      process.await_from({in.get()}, FaultCode::peer_silent, [&] { return in->at(i) != nullptr; });
      Order o{.m = 1};
      o.arm.frame.z.velocity = 2 * (memory += in->at(i)->F_a[2]);
      out->publish(to_message(o), i + 1);
    }
    throw FaultError(FaultCode::internal_error, "gives up");
  });
  EXPECT_EQ(v.compared, 3);
  EXPECT_EQ(v.differences, 1 + kMacrosteps - 3);
  ASSERT_TRUE(v.first);
  EXPECT_EQ(v.first->number, 2);
  EXPECT_NE(v.first->recomputed, "nothing");
}

TEST(Difference, OfBytesThatAreNoMessageIsToldByWhatTheyAre) {
  const Bytes order = bytes_of(agent_order_t{}), report = bytes_of(agent_report_t{}), none(30, 7);
  EXPECT_FALSE(difference("a.order", order, order));
  EXPECT_FALSE(difference("a.order", none, none));
  const auto told = [](const Bytes& logged, const Bytes& recomputed) {
    const LogDifference d = difference("a.order", logged, recomputed).value();
    EXPECT_EQ(d.channel, "a.order");
    EXPECT_EQ(d.field, "");
    return d.logged + " / " + d.recomputed;
  };
  EXPECT_EQ(told(order, report), "agent_order_t / agent_report_t");
  EXPECT_EQ(told(order, none), "agent_order_t / 30 bytes that are no message");
  EXPECT_EQ(told(none, order), "30 bytes that are no message / agent_order_t");
  EXPECT_EQ(told(none, Bytes(31, 7)), "30 bytes that are no message / 31 bytes that are no message");
}

TEST(Difference, NamesTheFunctionThatTheChannelCarries) {
  effector_command_t before{}, after{};
  after.header.stamp = before.header.stamp = 9;
  after.header.number = before.header.number = 4;
  after.outputs = 5;
  const auto function = [&](const char* channel) {
    return difference(channel, bytes_of(before), bytes_of(after)).value().function;
  };
  EXPECT_EQ(function("arm1.command"), "f_ce");
  EXPECT_EQ(function("arm1.report"), "f_cT");
  EXPECT_EQ(function("arm1.order"), "f_cT");
  EXPECT_EQ(function("servo"), "f_cc");
  EXPECT_EQ(function("arm1.reply"), "");
  EXPECT_EQ(function("hand.order"), "") << "the operator's hand is no agent";
  const LogDifference d = difference("arm1.command", bytes_of(before), bytes_of(after)).value();
  EXPECT_EQ(d.number, 4);
  EXPECT_EQ(d.stamp, 9);
  EXPECT_EQ(d.field, "outputs");
  EXPECT_EQ(d.logged, "0");
  EXPECT_EQ(d.recomputed, "5");
}

TEST_F(LogCheck, AVerdictGoesThroughJsonUnchanged) {
  const LogVerdict v = check(2.5);
  const LogVerdict again = verdict_from_json(to_json(v));
  EXPECT_EQ(to_json(again), to_json(v));
  EXPECT_EQ(again.process, "mp");
  EXPECT_EQ(again.compared, v.compared);
  EXPECT_EQ(again.differences, v.differences);
  EXPECT_EQ(again.first->channel, v.first->channel);
  EXPECT_EQ(again.first->number, v.first->number);
  EXPECT_EQ(again.first->stamp, v.first->stamp);
  EXPECT_EQ(again.first->behaviour, v.first->behaviour);
  EXPECT_EQ(again.first->function, v.first->function);
  EXPECT_EQ(again.first->field, v.first->field);
  EXPECT_EQ(again.first->logged, v.first->logged);
  EXPECT_EQ(again.first->recomputed, v.first->recomputed);
  const LogVerdict other{.process = "edp", .incomplete = "half", .not_checked = "none"};
  EXPECT_EQ(verdict_from_json(to_json(other)).incomplete, "half");
  EXPECT_EQ(verdict_from_json(to_json(other)).not_checked, "none");
  EXPECT_FALSE(verdict_from_json(to_json(other)).first);
  EXPECT_THROW(static_cast<void>(verdict_from_json("no JSON")), FaultError);
}

}  // namespace
}  // namespace mrroc::link
