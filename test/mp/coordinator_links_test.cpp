// The coordinator's links by message: whom they wait for, which reports count, and when a stop ends them.
#include "mp/coordinator_links.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

#include "base/link/memory_bus.hpp"
#include "base/msg/convert.hpp"
#include "test/base/link/one_by_one_bus.hpp"
#include "test/mp/two_arms.hpp"

namespace mrroc::mp {
namespace {

using link::Phase;
using link::Process;

/// An operator who gives the number of the macrostep, and writes down what he is told.
struct Clerk final : OperatorAgent {
  void inform(std::int64_t i, int m) override { told.push_back({i, m}); }
  [[nodiscard]] bool has_hands() const override { return hands; }
  [[nodiscard]] bool here(std::int64_t i) const override { return i <= comes_until; }
  [[nodiscard]] const link::InboxBase* inbox() const override { return box; }
  OperatorImage image(std::int64_t i) override { return {.trigger = i, .paused = paused}; }

  struct Told {
    std::int64_t i{};
    int m{};
    friend bool operator==(const Told&, const Told&) = default;
  };
  std::vector<Told> told;
  std::int64_t comes_until{1'000'000};
  bool hands{};
  bool paused{};
  const link::InboxBase* box{};
};

/// MP's process in this thread; the test says what two arms and the supervisor say.
class Links : public ::testing::Test {
 protected:
  /// Makes everything anew.
  void begin(ClockKind clock, std::chrono::milliseconds timeout = std::chrono::seconds(20),
             std::chrono::microseconds macrostep = {}, const link::OtherLinks& needed = {}) {
    links.reset();
    hand.reset();
    mp.reset();
    reports.clear();
    orders.clear();
    own.reset();
    own = std::make_unique<link::test::OneByOneBus>(hub.open());
    others = hub.open();
    link::NodeContext m;
    m.session = "links";
    m.name = "mp";
    m.roster = {"mp", "ecp-a", "ecp-b"};
    m.clock = clock;
    m.timeout = timeout;
    m.macrostep = macrostep;
    mp.emplace(*own, m);
    hand = mp->inbox<agent_report_t>("hand.report");
    clerk.box = hand.get();
    links.emplace(*mp, std::vector<std::string>{"a", "b"}, clerk, TaskClock::ramped(), needed);
    for (const char* const arm : {"a", "b"}) {
      reports.push_back(std::make_unique<link::Outbox<agent_report_t>>(
          *others, mp->route(std::string(arm) + ".report"), m.session_id));
      orders.push_back(std::make_unique<link::Queue<agent_order_t>>(
          *others, mp->route(std::string(arm) + ".order"), m.session_id));
    }
    supervisor.emplace(*others, mp->route("supervisor"), m.session_id);
    say(Phase::running);
  }
  void say(Phase phase, std::int64_t as_of = 0) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    m.as_of = as_of;
    supervisor->publish(m, 0);
  }
  /// @return a report that tells its macrostep by m and its arm by the sensor
  static Report told(std::size_t arm, std::int64_t i) {
    Report r;
    r.m = static_cast<int>(i);
    r.sensor = static_cast<int>(arm) + 1;
    return r;
  }
  void report(std::size_t arm, std::int64_t i) { report(arm, i, told(arm, i)); }
  void report(std::size_t arm, std::int64_t i, const Report& r) { reports[arm]->publish(to_message(r), i); }
  void report_both(std::int64_t i) {
    report(0, i);
    report(1, i);
  }

  Clerk clerk;
  link::MemoryHub hub;
  std::unique_ptr<link::Bus> own, others;
  std::optional<Process> mp;
  std::unique_ptr<link::Inbox<agent_report_t>> hand;
  std::optional<CoordinatorLinks> links;
  std::vector<std::unique_ptr<link::Outbox<agent_report_t>>> reports;
  std::vector<std::unique_ptr<link::Queue<agent_order_t>>> orders;
  std::optional<link::Outbox<supervisor_t>> supervisor;
};

TEST_F(Links, TheSimulationLearnsOfAPauseOfHandsAndOfTheEnd) {
  begin(ClockKind::step);
  link::Queue<simulation_control_t> told(*others, mp->route("simulation.control"), 1);
  report_both(1);
  clerk.paused = true;  // in macrostep 1, of which the message for macrostep 2 tells
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  clerk.paused = false;
  clerk.hands = true;
  links->send(std::array<Order, 2>{});
  report_both(2);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  std::array<Order, 2> last;
  last[0].finished = last[1].finished = true;
  links->send(last);
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  using Row = std::array<std::int64_t, 4>;
  std::vector<Row> rows;
  while (const auto m = told.take()) rows.push_back({m->header.stamp, m->paused, m->hands, m->finished});
  EXPECT_EQ(rows, (std::vector<Row>{{1, 0, 0, 0}, {2, 1, 1, 0}, {3, 0, 1, 1}}));
}

TEST_F(Links, EveryMacrostepHasTheReportsOfAllArmsAndTheOperatorsImage) {
  begin(ClockKind::step);
  report_both(1);
  ASSERT_EQ(links->begin({.m = 7}), Outcome::terminated);
  for (std::int64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(links->i(), i);
    for (std::size_t arm = 0; arm < 2; ++arm) {
      EXPECT_EQ(links->report(arm).m, i);
      EXPECT_EQ(links->report(arm).sensor, static_cast<int>(arm) + 1);
    }
    EXPECT_EQ(links->operator_image().trigger, i);
    if (i == 1) report(1, 2);
    report(1, i + 2);  // this arm is one ahead
    report(0, i + 1);
    ASSERT_EQ(links->wait(), Outcome::terminated);
  }
}

TEST_F(Links, AnOrderIsForTheNextMacrostepAndEachArmHasItsOwn) {
  begin(ClockKind::step);
  report_both(1);
  ASSERT_EQ(links->begin({.m = 7}), Outcome::terminated);
  links->send(std::array{Order{.m = 3, .variant = 10}, Order{.m = 3, .variant = 20, .finished = true}});
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  for (std::size_t arm = 0; arm < 2; ++arm) {
    const auto first = orders[arm]->take(), second = orders[arm]->take();
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->header.stamp, 1);
    EXPECT_EQ(first->m, 7);
    EXPECT_EQ(second->header.stamp, 2);
    EXPECT_EQ(second->variant, arm == 0 ? 10 : 20);
    EXPECT_FALSE(orders[arm]->take());
  }
  EXPECT_EQ(clerk.told, (std::vector<Clerk::Told>{{1, 7}, {2, 3}}));
}

TEST_F(Links, WhatElseIsSentIsForTheNextMacrostepToo) {
  struct Stamps final : link::Outgoing {
    void send(std::int64_t stamp) override { all.push_back(stamp); }
    void end() override { ended_behind = all.size(); }
    std::vector<std::int64_t> all;
    std::size_t ended_behind{};
  } sent;
  link::OtherLinks other;
  other.outgoing = {&sent};
  begin(ClockKind::step, std::chrono::seconds(20), {}, other);
  report_both(1);
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  for (std::int64_t i = 2; i <= 4; ++i) {
    links->send(std::vector<Order>(2));
    report_both(i);
    ASSERT_EQ(links->wait(), Outcome::terminated);
  }
  EXPECT_EQ(sent.all, (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(sent.ended_behind, 0U);
  links->send(std::vector<Order>(2, Order{.finished = true}));
  EXPECT_EQ(sent.ended_behind, 5U) << "the last one first";
}

TEST_F(Links, WithoutOneOfTheReportsOrTheOperatorNothingGoesOn) {
  for (const int missing : {0, 1, 2}) {
    begin(ClockKind::step, std::chrono::milliseconds(50));
    clerk.comes_until = missing == 2 ? 0 : 100;
    for (const std::size_t arm : {0U, 1U})
      if (static_cast<int>(arm) != missing) report(arm, 1);
    EXPECT_EQ(links->begin({}), Outcome::faulted) << missing;
    EXPECT_EQ(links->fault().code, FaultCode::peer_silent) << missing;
    const std::string who = std::array{"links.a.report, ", "links.b.report, ", "links.hand.report, "}.at(
        static_cast<std::size_t>(missing));
    EXPECT_TRUE(links->fault().text.view().starts_with(who)) << links->fault().text.view();
  }
}

TEST_F(Links, AStopEndsItInTheAgreedMacrostepAndInNoneBefore) {
  for (const ClockKind clock : {ClockKind::step, ClockKind::wall}) {
    begin(clock);
    report_both(1);
    ASSERT_EQ(links->begin({}), Outcome::terminated);
    say(Phase::stopping, 4);
    for (std::int64_t i = 2; i <= 3; ++i) {
      report_both(i);
      ASSERT_EQ(links->wait(), Outcome::terminated) << "everybody works on until then";
    }
    report_both(4);
    EXPECT_EQ(links->wait(), Outcome::aborted);
    EXPECT_EQ(links->i(), 4);
  }
}

TEST_F(Links, AStopAtOnceNeedsNoReport) {
  begin(ClockKind::step, std::chrono::milliseconds(200));
  say(Phase::stopping, 0);
  EXPECT_EQ(links->begin({}), Outcome::aborted);
}

TEST_F(Links, AReportWithANumberThatIsNotFiniteIsMalformed) {
  for (int number = 0; number < 13; ++number)
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      begin(ClockKind::step);
      Report r = told(1, 1);
      const auto k = static_cast<std::size_t>(number % 6);
      (number == 12 ? r.gripper : number < 6 ? r.T_0E[k] : r.F_a.v[k]) = bad;
      report(0, 1);
      report(1, 1, r);
      EXPECT_EQ(links->begin({}), Outcome::faulted) << number;
      EXPECT_EQ(links->fault().code, FaultCode::malformed_message);
      EXPECT_NE(links->fault().text.view().find("b.report"), std::string_view::npos)
          << links->fault().text.view();
    }
}

TEST_F(Links, AFaultOfAnArmIsTheCoordinatorsUnlessItsCommandWasOnlyLost) {
  struct Case {
    Verdict verdict;
    FaultCode code;
    bool ends;
  };
  for (const Case& c :
       {Case{Verdict::refused, FaultCode::joint_limit, true},
        Case{Verdict::failed, FaultCode::joint_limit, true},
        Case{Verdict::refused, FaultCode::lost_command, false},
        Case{Verdict::none, FaultCode::joint_limit, false}, Case{Verdict::executed, FaultCode::none, false},
        Case{Verdict::refused, FaultCode::none, false}})
    for (const std::size_t arm : {0U, 1U}) {
      begin(ClockKind::step);
      Report r = told(arm, 1);
      r.verdict = c.verdict;
      r.fault.code = c.code;
      report(arm, 1, r);
      report(1 - arm, 1);
      EXPECT_EQ(links->begin({}), c.ends ? Outcome::faulted : Outcome::terminated);
      EXPECT_EQ(links->fault().code, c.ends ? c.code : FaultCode::none);
    }
}

// With the wall clock the arm that is behind sets the pace, and the other one is seen as it was then.
TEST_F(Links, WithTheWallClockItGoesOnToTheNewestMacrostepOfWhichAllHaveReported) {
  begin(ClockKind::wall);
  report_both(1);
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  for (std::int64_t i = 2; i <= 10; ++i) report(0, i);
  for (std::int64_t i = 2; i <= 7; ++i) report(1, i);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 7);
  EXPECT_EQ(links->report(0).m, 7) << "not the newest: that would be of another macrostep";
  EXPECT_EQ(links->report(1).m, 7);
  EXPECT_EQ(links->operator_image().trigger, 7);
  report(1, 9);  // 8 is lost
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 9);
  EXPECT_EQ(links->report(0).m, 9);
  link::Inbox<process_status_t> status(*others, mp->route("mp.status"), 1);
  mp->report_done();
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  ASSERT_TRUE(status.newest());
  EXPECT_EQ(status.newest()->skipped, 5 + 1) << "2 to 6, and 8";
  EXPECT_EQ(status.newest()->macrostep, 9);
  EXPECT_EQ(status.newest()->step, 0);
}

TEST_F(Links, WithTheWallClockAReportThatIsMissingIsReplacedByTheNewest) {
  begin(ClockKind::wall);
  report_both(1);
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  report(0, 2);
  report(0, 4);
  report(1, 3);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 3);
  EXPECT_EQ(links->report(1).m, 3);
  EXPECT_EQ(links->report(0).m, 4);
}

TEST_F(Links, TheSupervisorHearsInWhichMacrostepItIs) {
  begin(ClockKind::step);
  link::Inbox<process_status_t> status(*others, mp->route("mp.status"), 1);
  for (std::int64_t i = 1; i <= 3; ++i) {
    report_both(i);
    ASSERT_EQ(i == 1 ? links->begin({}) : links->wait(), Outcome::terminated);
    mp->report_done();
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    EXPECT_EQ(status.newest()->macrostep, i);
    EXPECT_EQ(status.newest()->step, 0);
    EXPECT_EQ(status.newest()->skipped, 0);
  }
}

TEST_F(Links, InAPacedRunThreeFifthsOfAMacrostepAreTheOperatorsUnlessTheNextReportsOrAStopCome) {
  using namespace std::chrono_literals;
  const auto lasts = [&](const std::function<void()>& meanwhile, std::chrono::microseconds macrostep,
                         Outcome wanted) {
    begin(ClockKind::step, 20s, macrostep);
    report_both(1);
    meanwhile();
    const auto begun = Process::Clock::now();
    EXPECT_EQ(links->begin({}), wanted);
    return Process::Clock::now() - begun;
  };
  EXPECT_GE(lasts([] {}, 100ms, Outcome::terminated), 60ms);
  EXPECT_LT(lasts([&] { report_both(2); }, 30s, Outcome::terminated), 10s);
  EXPECT_GE(lasts([&] { report(0, 2); }, 100ms, Outcome::terminated), 60ms) << "the other one is behind";
  EXPECT_LT(lasts([&] { say(Phase::stopping, 1); }, 30s, Outcome::aborted), 10s);
  EXPECT_LT(lasts([] {}, 5s, Outcome::terminated), 4900ms) << "the rest is for the orders";
}

TEST_F(Links, AFaultIsPassedOnWithAllThatIsKnownOfIt) {
  begin(ClockKind::step);
  Report r = told(1, 1);
  r.verdict = Verdict::failed;
  r.fault = {.code = FaultCode::joint_limit, .axis = 3, .value = 2.5, .limit = 2};
  report(0, 1);
  report(1, 1, r);
  EXPECT_EQ(links->begin({}), Outcome::faulted);
  EXPECT_EQ(links->fault().axis, 3);
  EXPECT_EQ(links->fault().value, 2.5);
  EXPECT_EQ(links->fault().limit, 2);
}

TEST_F(Links, APortGivesItsImagesAndTellsTheBehaviourThatAskedForThem) {
  begin(ClockKind::step);
  link::Inbox<process_status_t> status(*others, mp->route("mp.status"), 1);
  report_both(1);
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  std::vector<std::pair<int, std::int64_t>> seen;
  CoordinatorPort<Two, std::function<void(const Motion<Two>&, const Two::X&)>> port(
      *links, [&](const Motion<Two>& motion, const Two::X& x) { seen.emplace_back(motion.m, x.i); });
  Two::X x;
  port.read(x);
  EXPECT_EQ(x.i, 1);
  EXPECT_TRUE(seen.empty()) << "no behaviour has begun";
  Motion<Two> motion{};
  motion.m = 6;
  motion.name = "hold";
  Two::Y y;
  y.T[0].m = 8;
  y.T[1].variant = 3;
  port.dispatch(motion, y);
  EXPECT_EQ(mp->behaviour(), "6, hold");
  report_both(2);
  ASSERT_EQ(port.wait(), Outcome::terminated);
  port.read(x);
  EXPECT_EQ(x.i, 2);
  EXPECT_EQ(x.T.agent[0].sensor, 1);
  EXPECT_EQ(x.T.agent[1].sensor, 2);
  EXPECT_EQ(x.T.agent[1].m, 2);
  EXPECT_EQ(x.T.h.trigger, 2);
  EXPECT_EQ(seen, (std::vector<std::pair<int, std::int64_t>>{{6, 2}}));
  EXPECT_EQ(clerk.told.back(), (Clerk::Told{2, 8}));
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  std::ignore = orders[1]->take();
  const auto second = orders[1]->take();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->variant, 3);
}

/// The same with a clock in its images.
struct Timed {
  struct X : Two::X {
    TaskTime t;
  };
  using Y = Two::Y;
};

TEST_F(Links, APortTellsTheTaskTimeToAnAgentWhoseImagesHaveOne) {
  begin(ClockKind::step);
  report_both(1);
  clerk.paused = true;
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  std::vector<double> seen;
  CoordinatorPort<Timed, std::function<void(const Motion<Timed>&, const Timed::X&)>> port(
      *links, [&](const Motion<Timed>& /*motion*/, const Timed::X& x) { seen.push_back(x.t.time); });
  Motion<Timed> motion{};
  motion.name = "hold";
  Timed::X x;
  double time = 0;
  for (int i = 1; i <= 25; ++i) {
    port.read(x);
    const double pace = std::max(0., 1 - 0.1 * i);  // it comes to a stand in ten macrosteps
    EXPECT_NEAR(x.t.pace, pace, 1e-12) << i;
    EXPECT_NEAR(x.t.time, time, 1e-12) << i;
    EXPECT_TRUE(x.t.paused);
    if (i > 1) {
      EXPECT_EQ(seen.back(), x.t.time) << "who observes knows it, too";
    }
    time += pace;
    port.dispatch(motion, Timed::Y{});
    report_both(i + 1);
    ASSERT_EQ(port.wait(), Outcome::terminated);
  }
  EXPECT_EQ(seen.size(), 24U);
}

TEST_F(Links, WhatElseAMacrostepNeedsIsAskedForThatMacrostepAndWithoutAStep) {
  constexpr std::int64_t kComesUntil = 3;
  std::vector<std::pair<std::int64_t, std::int64_t>> asked;
  link::OtherLinks needed;
  needed.here = [&](std::int64_t i, std::int64_t step) {
    if (asked.empty() || asked.back() != std::pair(i, step)) asked.emplace_back(i, step);
    return i <= kComesUntil;
  };
  begin(ClockKind::step, std::chrono::milliseconds(200), {}, needed);
  report_both(1);
  ASSERT_EQ(links->begin({}), Outcome::terminated);
  for (std::int64_t i = 2; i <= kComesUntil; ++i) {
    report_both(i);
    ASSERT_EQ(links->wait(), Outcome::terminated) << i;
  }
  report_both(4);
  EXPECT_EQ(links->wait(), Outcome::faulted) << "it does not come";
  EXPECT_EQ(links->fault().code, FaultCode::peer_silent);
  EXPECT_EQ(asked, (std::vector<std::pair<std::int64_t, std::int64_t>>{{1, 0}, {2, 0}, {3, 0}, {4, 0}}))
      << "the coordinator has no effector, and no step of one";
}

}  // namespace
}  // namespace mrroc::mp
