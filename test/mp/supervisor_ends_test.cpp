// The supervisor brings a system to its end: it waits for the robots and the nodes, ends what does not
// leave, and names it.
#include <gtest/gtest.h>

#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "base/fault.hpp"
#include "mrroc/console_t.hpp"
#include "test/mp/supervisor_ends.hpp"

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;
using test::Phase;
using test::Process;
using test::ProcessState;
using test::SupervisorEnds;
using test::Watch;

TEST(SupervisorTimes, AreThoseOfWhichPeopleAreTold) {
  constexpr SupervisorTimes kUsual;
  EXPECT_EQ(kUsual.assembling, 60s);
  EXPECT_EQ(kUsual.hang, 10s);
  EXPECT_EQ(kUsual.come_to_rest, 20s);
  EXPECT_EQ(kUsual.leaves, 2s);
  EXPECT_EQ(kUsual.finish, 20s);
  EXPECT_EQ(kUsual.leave, 5s);
  EXPECT_EQ(StopEscalation::kConfirm, 3s);
  EXPECT_EQ(StopEscalation::kHurry, 500ms);
  EXPECT_EQ(StopEscalation::kTerminate, 500ms);
}

TEST_F(SupervisorEnds, ItsWordIsRepeatedTenTimesASecondAndNotMoreOften) {
  begin({sleeper("one")});
  int heard = 0;
  const Watch watch;
  while (watch.passed() < 350ms) {
    mp->poll();
    while (words->take()) ++heard;
  }
  const auto periods = static_cast<int>(watch.passed() / 100ms);
  EXPECT_LE(heard, periods + 1);
  mp->poll();
  while (words->take()) {
  }
  std::this_thread::sleep_for(120ms);
  mp->poll();
  const auto word = words->take();
  ASSERT_TRUE(word);
  EXPECT_EQ(word->phase, static_cast<int>(Phase::assembling));
}

TEST_F(SupervisorEnds, AReplayHearsWhatWasSaidInTheRunAndNotWhatItSaysItself) {
  for (const bool replayed : {false, true}) {
    begin({}, {}, replayed);
    supervisor_t said{};
    said.phase = static_cast<int>(Phase::running);
    supervisor->stop({.code = FaultCode::operator_stop}, 3);
    link::Outbox<supervisor_t> run(*bus, mp->route("supervisor"), 1);
    for (int k = 0; k < 5; ++k) run.publish(said, 0);
    EXPECT_EQ(mp->phase(), replayed ? Phase::running : Phase::stopping);
  }
}

TEST_F(SupervisorEnds, AnEndIsSaidAtOnceAndOnce) {
  begin({});
  run();
  mp->report_done();
  supervisor->end();
  EXPECT_FALSE(supervisor->fault());
  EXPECT_EQ(mp->phase(), Phase::finished);
  while (words->take()) {
  }
  supervisor.reset();
  EXPECT_FALSE(words->take()) << "it has been said";
  EXPECT_FALSE(mp->on_service) << "nobody polls what has gone";
  begin({});
  supervisor.reset();
  const auto last = words->take();
  ASSERT_TRUE(last) << "threads must end";
  EXPECT_EQ(last->phase, static_cast<int>(Phase::finished));
}

TEST_F(SupervisorEnds, WhatWasSaidLastIsWrittenDown) {
  begin({sleeper("one")});
  run();
  mp_is_done();
  says("one", ProcessState::done);
  link::Outbox<console_t> console(*bus, mp->route("one.console"), 1);
  console_t m{};
  link::put_text(m.text, "good bye");
  console.publish(m, 0);
  supervisor->end();
  EXPECT_EQ(supervisor->last_message(), "one: good bye");
}

TEST_F(SupervisorEnds, ANodeThatDoesNotComeToItsEndIsNamed) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  begin({sleeper("one"), sleeper("two"), sleeper("three")}, {.come_to_rest = 1ms, .finish = 200ms});
  run();
  mp_is_done();
  says("one", ProcessState::done);
  const Watch watch;
  supervisor->end();
  EXPECT_GE(watch.passed(), 200ms);
  ASSERT_TRUE(supervisor->fault());
  EXPECT_EQ(supervisor->fault()->code, FaultCode::process_hung);
  EXPECT_EQ(supervisor->fault()->process.view(), "two") << "the first one that has not ended";
  EXPECT_EQ(supervisor->fault()->text.view(), "the task is over, and two does not come to its end");
  EXPECT_EQ(logged("does not come to its end"), 1);
}

TEST_F(SupervisorEnds, PartsMayEndOneAfterTheOtherWhenTheTaskIsOver) {
  begin({{"one", {}, {}, {}}, {"two", {}, {}, {}}}, {.leaves = 30ms});
  run();
  mp_is_done();
  supervisor->on_alarm = {};
  int polls = 0;
  const auto own_duties = mp->on_service;
  const Watch watch;
  mp->on_service = [&] {
    own_duties();
    process_status_t m{};
    m.state = static_cast<int>(ProcessState::done);
    if (++polls == 1) own.at("one")->publish(m, 0);
    if (watch.passed() > 200ms) own.at("two")->publish(m, 0);
  };
  supervisor->end();
  EXPECT_GE(watch.passed(), 200ms);
  EXPECT_FALSE(supervisor->fault());
}

TEST_F(SupervisorEnds, TheLastMacrostepsOfSlowRobotsAreWaitedForBesides) {
  begin({{"one", {}, {}, {}}}, {.finish = 50ms}, false, 50ms);
  run();
  mp_is_done();
  const auto own_duties = mp->on_service;
  const Watch watch;
  mp->on_service = [&] {
    own_duties();
    process_status_t m{};
    m.state = static_cast<int>(ProcessState::done);
    if (watch.passed() > 300ms) own.at("one")->publish(m, 0);
  };
  supervisor->end();
  EXPECT_FALSE(supervisor->fault());
}

TEST_F(SupervisorEnds, AfterAStopTheRobotsAreWaitedForUntilTheyRestOrTheirDriversHaveDoneTheirWork) {
  const auto drives = [](process_status_t& m) { m.effector = 1; };
  for (const bool rests : {true, false}) {
    begin({{"edp", {}, {}, {}}, {"one", {}, {}, {}}});
    run();
    says("edp", ProcessState::running, drives);
    supervisor->stop({.code = FaultCode::operator_stop}, 0);
    const auto own_duties = mp->on_service;
    const Watch watch;
    bool finished_before = false;
    mp->on_service = [&] {
      own_duties();
      if (watch.passed() < 200ms) {
        finished_before = finished_before || mp->phase() == Phase::finished;
        return;
      }
      process_status_t m{};
      m.state = static_cast<int>(rests ? ProcessState::running : ProcessState::done);
      m.effector = 1;
      m.at_rest = rests ? 1 : 0;
      own.at("edp")->publish(m, 0);
    };
    supervisor->end();
    EXPECT_GE(watch.passed(), 200ms);
    EXPECT_LT(watch.passed(), 15s);
    EXPECT_FALSE(finished_before);
  }
}

TEST_F(SupervisorEnds, WhereNothingCanMoveNobodyWaitsForRest) {
  begin({{"one", {}, {}, {}}});  // no driver
  run();
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  Watch watch;
  supervisor->end();
  EXPECT_LT(watch.passed(), 10s);
  begin({{"edp", {}, {}, {}}});
  says("edp", ProcessState::starting, [](process_status_t& m) { m.effector = 1; });
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  watch = {};
  supervisor->end();
  EXPECT_LT(watch.passed(), 10s) << "it never ran";
}

TEST_F(SupervisorEnds, AProgramThatDoesNotLeaveIsKilled) {
  begin({child("one", writes_its_number("pid") + "; trap '' TERM; while :; do sleep 0.05; done")},
        {.leave = 200ms});
  supervisor->start_processes({});
  run();
  EXPECT_TRUE(until([&] { return !text_of("pid").empty(); }));
  says("one", ProcessState::done);
  mp_is_done();
  const Watch watch;
  supervisor->end();
  EXPECT_GE(watch.passed(), 200ms);
  EXPECT_LT(watch.passed(), 60s);
  EXPECT_TRUE(gone("pid"));
  EXPECT_FALSE(supervisor->fault());
  EXPECT_EQ(state_of(1), ProcessState::done) << "it had done its work";
}

TEST_F(SupervisorEnds, AThreadThatDoesNotConfirmIsNamedAndCannotBeEndedAlone) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  std::promise<void> let_go;
  begin({{"thread", {}, {}, [&](Process&) { let_go.get_future().wait(); }}});
  link::MemoryHub hub;  // where it says nothing
  supervisor->start_threads(hub);
  run();
  std::vector<std::string> alarms;
  supervisor->on_alarm = [&](const std::string& line) { alarms.push_back(line); };
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  supervisor->hurry();
  EXPECT_FALSE(supervisor->stop_confirmed());
  EXPECT_TRUE(until([&] { return !alarms.empty(); }));
  pass(StopEscalation::kTerminate + 100ms);
  EXPECT_EQ(alarms, std::vector<std::string>{"thread has not confirmed the stop in 0.5 s: it is a thread, "
                                             "with which the whole program ends"});
  EXPECT_FALSE(mp->dead("thread"));
  EXPECT_EQ(state_of(1), ProcessState::ready);
  let_go.set_value();
  EXPECT_TRUE(until([&] { return supervisor->stop_confirmed(); })) << "it has ended";
  supervisor->end();
}

}  // namespace
}  // namespace mrroc::mp
