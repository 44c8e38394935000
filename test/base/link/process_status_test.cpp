// Reports of a process: signs of life, progress, behaviours, its end.
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "base/link/process.hpp"
#include "base/link/text.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/ring.hpp"

namespace mrroc::link {
namespace {

using test::context_of;

/// Lets a process look at its messages again and again for so long.
/// @return signs of life that it gives by itself, and how long that took
template <class Look>
std::pair<int, std::chrono::duration<double>> signs_of_life(ClockKind clock, std::chrono::milliseconds time,
                                                            Look look) {
  test::DirectBus bus;
  NodeContext m = context_of("b");
  m.clock = clock;
  m.timeout = std::chrono::milliseconds(0);  // nobody watches the supervisor
  Process p(bus, m);
  Outbox<supervisor_t> supervisor(bus, p.route("supervisor"), 1);
  supervisor_t running{};
  running.phase = static_cast<int>(Phase::running);
  supervisor.publish(running, 0);
  const auto begun = Process::Clock::now();
  p.assemble();
  look(p);
  const std::size_t before = bus.published.size();
  while (Process::Clock::now() < begun + time) look(p);
  return {static_cast<int>(bus.published.size() - before), Process::Clock::now() - begun};
}

TEST(Process, GivesASignOfLifeTwiceASecondHoweverOftenItLooks) {
  const auto waits = [](Process& p) {
    p.await([] { return false; }, Process::Clock::now() + std::chrono::milliseconds(2));
  };
  const auto polls = [](Process& p) { p.poll(); };
  const auto expect = [](const auto& given) {
    EXPECT_GE(given.first, 1);
    EXPECT_LE(given.first, given.second.count() / 0.5);
  };
  expect(signs_of_life(ClockKind::step, std::chrono::milliseconds(900), waits));
  expect(signs_of_life(ClockKind::wall, std::chrono::milliseconds(900), polls));
}

TEST(Process, StatesHaveTheirNames) {
  std::vector<std::string_view> names;
  for (int s = 0; s <= static_cast<int>(ProcessState::dead); ++s)
    names.push_back(to_string(static_cast<ProcessState>(s)));
  EXPECT_EQ(names,
            (std::vector<std::string_view>{"starting", "ready", "running", "done", "faulted", "dead"}));
  EXPECT_EQ(to_string(static_cast<ProcessState>(77)), "?");
}

/// A process and what it tells.
struct Talker {
  explicit Talker(ClockKind clock = ClockKind::step) {
    NodeContext m = context_of("b");
    m.clock = clock;
    p.emplace(bus, m);
    in.emplace(bus, p->route("b.status"), 1);
    supervisor.emplace(bus, p->route("supervisor"), 1);
  }
  void say(Phase phase, std::int64_t as_of = 0) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    m.as_of = as_of;
    supervisor->publish(m, 0);
  }
  /// @return what it has told last, if it has told anything
  std::optional<process_status_t> last() {
    std::optional<process_status_t> newest;
    while (const auto s = in->take()) newest = s;
    return newest;
  }
  test::DirectBus bus;
  std::optional<Process> p;
  std::optional<Queue<process_status_t>> in;
  std::optional<Outbox<supervisor_t>> supervisor;
};

TEST(Process, TellsHowFarItIsAndWhatItDoes) {
  Talker t;
  t.p->report_progress(12, 345);
  t.p->report_skipped(3);
  t.p->report_skipped(4);
  EXPECT_FALSE(t.last()) << "with the next sign of life";
  EXPECT_EQ(t.p->behaviour(), "");
  t.p->in_behaviour(3, "press", "contact");
  const auto s = t.last();
  ASSERT_TRUE(s);
  EXPECT_EQ(get_text(s->name), "b");
  EXPECT_EQ(s->header.stamp, 12);
  EXPECT_EQ(s->macrostep, 12);
  EXPECT_EQ(s->step, 345);
  EXPECT_EQ(s->skipped, 7);
  EXPECT_EQ(s->m, 3);
  EXPECT_EQ(get_text(s->behaviour), "press");
  EXPECT_EQ(get_text(s->ended_because), "");
  EXPECT_EQ(t.p->behaviour(), "3, press");
}

TEST(Process, TellsWhyABehaviourEndedWhenTheNextOneBegins) {
  Talker t;
  t.p->report_progress(5, 0);
  t.p->in_behaviour(1, "approach", "contact");
  t.last();
  t.p->in_behaviour(1, "approach", "contact");
  EXPECT_FALSE(t.last()) << "nothing new";
  t.p->report_progress(9, 0);
  t.p->in_behaviour(1, "hold");
  EXPECT_EQ(get_text(t.last().value().ended_because), "approach: contact");
  t.p->report_progress(10, 0);
  t.p->in_behaviour(2, "hold");
  EXPECT_EQ(get_text(t.last().value().ended_because), "hold, ended after 1 macrostep");
  t.p->report_progress(17, 0);
  t.p->in_behaviour(3, "rest");
  EXPECT_EQ(get_text(t.last().value().ended_because), "hold, ended after 7 macrosteps");
}

TEST(Process, ADriverTellsItsStateAtOnceWhereTheSystemStops) {
  Talker t;
  t.say(Phase::running);
  t.p->report_effector(4);
  EXPECT_FALSE(t.last());
  t.p->report_progress(1, 1);
  t.say(Phase::stopping, 44);
  t.p->report_effector(4);
  EXPECT_FALSE(t.last()) << "it has not changed";
  t.p->report_effector(5);
  const auto s = t.last();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->effector, 6);
  EXPECT_EQ(s->phase, static_cast<int>(Phase::stopping));
  EXPECT_EQ(s->as_of, 44);
}

TEST(Process, ADriverTellsThatItsRobotIsAtRest) {
  Talker t;
  t.p->report_rest(true, 30);
  const auto s = t.last();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->at_rest, 1);
  EXPECT_EQ(s->stop_steps, 30);
  t.p->report_rest(false, 0);
  EXPECT_EQ(t.last().value().at_rest, 0);
}

TEST(Process, ItsLastStatusHasTheFingerprintsOfWhatItSent) {
  Talker t;
  const auto one = t.p->outbox<operator_order_t>("b.one"), two = t.p->outbox<operator_order_t>("b.two");
  for (int k = 0; k < 3; ++k) one->publish({}, k);
  two->publish({}, 1);
  EXPECT_TRUE(t.p->sends("ring.b.two"));
  EXPECT_FALSE(t.p->sends("ring.a.out"));
  t.p->report_done();
  const auto s = t.last();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->state, static_cast<int>(ProcessState::done));
  ASSERT_EQ(s->n_hashes, 2);
  EXPECT_EQ(get_text(s->hash[0].channel), ".b.one") << "without the session, which differs from run to run";
  EXPECT_EQ(s->hash[0].count, 3);
  EXPECT_EQ(s->hash[0].hash, static_cast<std::int64_t>(one->hash()));
  EXPECT_EQ(get_text(s->hash[1].channel), ".b.two");
  EXPECT_EQ(s->hash[1].count, 1);
  EXPECT_NE(s->hash[0].hash, s->hash[1].hash);
  t.p->report_done();
  EXPECT_EQ(t.last().value().n_hashes, 2) << "told again, not twice as many";
}

TEST(Process, SaysItsLinesWithItsNameCodeAndMacrostep) {
  Talker t;
  Queue<console_t> lines(t.bus, t.p->route("b.console"), 1);
  t.p->report_progress(8, 80);
  t.p->log("it hurts", FaultCode::over_current);
  const auto line = lines.take();
  ASSERT_TRUE(line);
  EXPECT_EQ(line->header.stamp, 8);
  EXPECT_EQ(get_text(line->process), "b");
  EXPECT_EQ(get_text(line->text), "it hurts");
  EXPECT_EQ(line->code, static_cast<int>(FaultCode::over_current));
}

TEST(Process, AFaultOfAnotherKeepsThatOnesName) {
  Talker t;
  t.p->report_fault({.code = FaultCode::over_current, .process = "edp"});
  EXPECT_EQ(get_text(t.last().value().fault.process), "edp");
  t.p->report_done();
  EXPECT_EQ(t.last().value().state, static_cast<int>(ProcessState::faulted));
}

TEST(Process, TellsItsFaultWithEverything) {
  test::DirectBus bus;
  Process p(bus, context_of("b"));
  Queue<process_status_t> in(bus, p.route("b.status"), 1);
  Fault fault{.code = FaultCode::out_of_limits, .axis = 3, .value = 1.5, .limit = 1.25};
  fault.text = "the third joint";
  p.report_fault(fault);
  const auto s = in.take();
  ASSERT_TRUE(s);
  EXPECT_EQ(s->state, static_cast<int>(ProcessState::faulted));
  EXPECT_EQ(s->fault.code, static_cast<int>(FaultCode::out_of_limits));
  EXPECT_EQ(s->fault.axis, 3);
  EXPECT_EQ(s->fault.value, 1.5);
  EXPECT_EQ(s->fault.limit, 1.25);
  EXPECT_EQ(get_text(s->fault.process), "b");
  EXPECT_EQ(get_text(s->fault.text), "the third joint");
}

}  // namespace
}  // namespace mrroc::link
