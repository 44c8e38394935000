// A process that is recomputed from the log of its run: nothing differs, and what has been changed is named.
#include "base/link/log_check.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <deque>

#include "base/link/event_log.hpp"
#include "base/link/log_reader.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/message_type.hpp"
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
  EXPECT_EQ(v.first->recomputed, "nothing");
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
}

TEST_F(LogCheck, AVerdictGoesThroughJsonUnchanged) {
  const LogVerdict v = check(2.5);
  const LogVerdict again = verdict_from_json(to_json(v));
  EXPECT_EQ(to_json(again), to_json(v));
  EXPECT_EQ(again.first->behaviour, v.first->behaviour);
  EXPECT_THROW(static_cast<void>(verdict_from_json("no JSON")), FaultError);
}

}  // namespace
}  // namespace mrroc::link
