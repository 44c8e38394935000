// The supervisor starts the nodes, and finds those that die, hang, leave or do not obey.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "test/mp/supervisor_ends.hpp"

namespace mrroc::mp {
namespace {

using namespace std::chrono_literals;
using test::Phase;
using test::ProcessState;
using test::SupervisorEnds;
using test::Watch;

TEST_F(SupervisorEnds, EveryProgramGetsTheCommonArgumentsBeforeItsOwnAndTheInput) {
  const std::string file = (folder / "$0").string();
  begin({{"here", "/bin/sh", {"one", "own"}, {}},
         {"there", "/bin/sh", {"two"}, {}, {"/usr/bin/env", "WORD=far"}},
         {"none", {}, {"x"}, {}}});
  supervisor->start_processes(
      {"-c", "printf '%s,' \"$@\" \"$WORD\" > " + file + "; cat >> " + file + "; exit 0"}, "read");
  EXPECT_TRUE(until([&] { return state_of(1) >= ProcessState::done && state_of(2) >= ProcessState::done; }));
  EXPECT_EQ(text_of("one"), "own,,read");
  EXPECT_EQ(text_of("two"), "far,read");
  EXPECT_EQ(state_of(3), ProcessState::starting) << "it is no program";
}

TEST_F(SupervisorEnds, TheSystemRunsWhenTheLastOneIsReadyAndNotBefore) {
  begin({sleeper("one"), sleeper("two")});
  says("mp", ProcessState::ready);
  says("one", ProcessState::running);
  EXPECT_EQ(mp->phase(), Phase::assembling);
  says("two", ProcessState::starting);
  EXPECT_EQ(mp->phase(), Phase::assembling);
  says("two", ProcessState::ready);
  EXPECT_EQ(mp->phase(), Phase::running);
}

TEST_F(SupervisorEnds, WhoeverIsNotThereInTimeIsNamed) {
  begin({sleeper("one"), sleeper("two"), sleeper("three")}, {.assembling = 200ms});
  says("two", ProcessState::ready);
  const Watch watch;
  EXPECT_FALSE(mp->assemble());
  EXPECT_GE(watch.passed(), 190ms);
  ASSERT_TRUE(supervisor->fault());
  EXPECT_EQ(supervisor->fault()->code, FaultCode::not_ready);
  EXPECT_EQ(supervisor->fault()->text.view(), "not there after 0.2 s: one, three");
}

TEST_F(SupervisorEnds, AllThatHaveDiedAreDeclaredDeadAndTheFirstOneIsTheReason) {
  begin({child("one", "exit 3"), sleeper("two"), child("three", "kill -9 $$")});
  supervisor->start_processes({});
  EXPECT_TRUE(until([&] { return mp->dead("one") && mp->dead("three"); }));
  EXPECT_FALSE(mp->dead("two"));
  EXPECT_FALSE(mp->dead("mp"));
  ASSERT_TRUE(supervisor->fault());
  const std::string text(supervisor->fault()->text.view());
  EXPECT_TRUE(text == "one ended with exit status 3" || text == "three ended with signal 9 (Killed)") << text;
}

TEST_F(SupervisorEnds, AChildThatLeavesARunningSystemIsTold) {
  begin({child("one", "exit 0")});
  supervisor->start_processes({});
  EXPECT_TRUE(until([&] { return supervisor->fault().has_value(); }));
  EXPECT_EQ(supervisor->fault()->text.view(), "one ended with exit status 0 while the system was running");
  EXPECT_EQ(state_of(1), ProcessState::dead);
}

TEST_F(SupervisorEnds, AChildThatEndsWellInAStoppedSystemIsDoneAndOneThatDoesNotIsDead) {
  for (const bool well : {true, false}) {
    begin({child("one", well ? "read x; exit 0" : "read x; exit 1"), sleeper("two")});
    supervisor->start_processes({}, "x\n");
    supervisor->stop({.code = FaultCode::operator_stop}, 1000);
    EXPECT_TRUE(until([&] { return state_of(1) != ProcessState::starting; }));
    EXPECT_EQ(state_of(1), well ? ProcessState::done : ProcessState::dead);
    EXPECT_EQ(mp->dead("one"), !well);
    EXPECT_EQ(mp->stop_as_of(), well ? 1000 : 0) << "a death does not wait";
    EXPECT_EQ(supervisor->fault()->code, FaultCode::operator_stop);
  }
}

TEST_F(SupervisorEnds, OfAChildThatHasToldItsFaultThatIsTheReasonHoweverItEnds) {
  for (const bool well : {true, false}) {
    begin({child("one", well ? "sleep 0.2; exit 0" : "sleep 0.2; exit 3")});
    supervisor->start_processes({});
    says("one", ProcessState::faulted,
         [](process_status_t& m) { m.fault.code = static_cast<int>(FaultCode::over_current); });
    EXPECT_FALSE(mp->dead("one"));
    pass(400ms);
    EXPECT_TRUE(until([&] { return well || mp->dead("one"); }));
    EXPECT_EQ(mp->dead("one"), !well);
    EXPECT_EQ(state_of(1), ProcessState::faulted);
    EXPECT_EQ(supervisor->fault()->code, FaultCode::over_current);
    EXPECT_EQ(logged("process_died"), 0);
  }
}

TEST_F(SupervisorEnds, ANodeThatHangsIsKilledAndNamedAndOneThatSpeaksIsNot) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  begin({child("hangs", writes_its_number("pid") + "; exec sleep 600"), sleeper("speaks")}, {.hang = 3s});
  const Watch watch;
  supervisor->start_processes({});
  EXPECT_TRUE(until([&] {
    says("speaks", ProcessState::ready);
    return state_of(1) == ProcessState::dead;
  }));
  EXPECT_GE(watch.passed(), 3s);
  EXPECT_EQ(supervisor->fault()->code, FaultCode::process_hung);
  EXPECT_EQ(supervisor->fault()->process.view(), "hangs");
  EXPECT_EQ(supervisor->fault()->text.view(), "hangs has not been heard for 3 s");
  EXPECT_TRUE(mp->dead("hangs"));
  EXPECT_FALSE(mp->dead("speaks"));
  EXPECT_TRUE(until([&] { return gone("pid"); }));
}

TEST_F(SupervisorEnds, ANodeThatIsDoneMayStayForAWhileAndNotForLonger) {
  begin({sleeper("one"), sleeper("two")}, {.leaves = 300ms});
  run();
  mp_is_done();
  const Watch watch;
  says("two", ProcessState::done);
  EXPECT_TRUE(until([&] { return supervisor->fault().has_value(); }));
  EXPECT_GE(watch.passed(), 300ms);
  EXPECT_EQ(supervisor->fault()->code, FaultCode::ended_early);
  EXPECT_EQ(supervisor->fault()->process.view(), "two");
  EXPECT_EQ(supervisor->fault()->text.view(), "two says that it is done, and the task is not");
  EXPECT_EQ(mp->stop_as_of(), 0);
}

TEST_F(SupervisorEnds, MPMayBeDoneFirstAndBeforeTheSystemRunsNobodyHasLeft) {
  begin({sleeper("one"), sleeper("two")}, {.leaves = 1ms});
  says("one", ProcessState::done);
  pass(100ms);
  EXPECT_FALSE(supervisor->fault()) << "it assembles";
  begin({sleeper("one"), sleeper("two")}, {.leaves = 1ms});
  run();
  mp_is_done();
  pass(100ms);
  EXPECT_FALSE(supervisor->fault());
  supervisor->stop({.code = FaultCode::operator_stop}, 5);
  says("one", ProcessState::done);
  pass(100ms);
  EXPECT_EQ(mp->stop_as_of(), 5) << "in a system that stops nodes may be done";
}

TEST_F(SupervisorEnds, AStopIsConfirmedWhenEveryLivingNodeObeysItOrRestsSinceItsOwnFault) {
  for (const char* const last : {"one", "two"}) {
    begin({sleeper("one"), sleeper("two")});
    supervisor->start_processes({});
    run();
    const std::string other = last == std::string("one") ? "two" : "one";
    confirms(other);
    confirms(last);
    EXPECT_FALSE(supervisor->stop_confirmed()) << "nobody has stopped anything";
    supervisor->stop({.code = FaultCode::over_current}, 7);
    confirms(other, Phase::stopping, 7);
    confirms(last, Phase::running, 0);
    EXPECT_FALSE(supervisor->stop_confirmed());
    confirms(last, Phase::stopping, 8);
    EXPECT_FALSE(supervisor->stop_confirmed()) << "it still obeys for one macrostep more";
    confirms(last, Phase::stopping, 7);
    EXPECT_TRUE(supervisor->stop_confirmed());
    supervisor->stop({.code = FaultCode::process_died}, 0);
    EXPECT_FALSE(supervisor->stop_confirmed()) << "now it is at once";
    says(other, ProcessState::done);
    EXPECT_FALSE(supervisor->stop_confirmed());
    says(last, ProcessState::faulted);
    EXPECT_TRUE(supervisor->stop_confirmed());
  }
  begin({sleeper("one")});
  run();
  supervisor->stop({.code = FaultCode::over_current}, 0);
  EXPECT_TRUE(supervisor->stop_confirmed()) << "what does not live need not obey";
}

TEST_F(SupervisorEnds, OfAStopThatWasOrderedItIsTheReasonThatSomebodyDidNotConfirmItIfTheSystemRan) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  struct Case {
    FaultCode code;
    bool ran, becomes;
  };
  for (const Case& c :
       {Case{FaultCode::operator_stop, true, true}, Case{FaultCode::interrupted, true, true},
        Case{FaultCode::emergency_stop, true, true}, Case{FaultCode::over_current, true, false},
        Case{FaultCode::operator_stop, false, false}}) {
    const std::string asked = "trap 'echo x >> " + (folder / "asked").string() +
                              "; exit 0' TERM; echo x >> " + (folder / "ready").string() +
                              "; while :; do sleep 0.05; done";
    for (const char* const file : {"asked", "ready"}) std::filesystem::remove(folder / file);
    begin({child("one", asked), child("two", asked)});
    std::vector<std::string> alarms;
    if (c.code != FaultCode::interrupted)
      supervisor->on_alarm = [&](const std::string& line) { alarms.push_back(line); };
    supervisor->start_processes({});
    if (c.ran) run();
    EXPECT_TRUE(until([&] { return text_of("ready") == "x\nx\n"; })) << "they have set their traps";
    supervisor->stop({.code = c.code}, 0);
    supervisor->hurry();
    const Watch watch;
    EXPECT_TRUE(
        until([&] { return state_of(1) == ProcessState::done && state_of(2) == ProcessState::done; }));
    EXPECT_GE(watch.passed(), StopEscalation::kHurry);
    EXPECT_EQ(text_of("asked"), "x\nx\n") << "SIGTERM, once";
    EXPECT_EQ(supervisor->unconfirmed(), "one, two");
    EXPECT_EQ(supervisor->fault()->code, c.becomes ? FaultCode::stop_not_confirmed : c.code);
    if (c.becomes) {
      EXPECT_EQ(supervisor->fault()->text.view(), "not confirmed in 0.5 s by one, two");
    }
    EXPECT_EQ(logged("one has not confirmed the stop in 0.5 s: SIGTERM"), 1);
    if (supervisor->on_alarm) {
      EXPECT_EQ(alarms, (std::vector<std::string>{"one has not confirmed the stop in 0.5 s: SIGTERM",
                                                  "two has not confirmed the stop in 0.5 s: SIGTERM"}));
    }
  }
}

TEST_F(SupervisorEnds, TheThirdWordKillsWhatLivesAndLeavesAloneWhatHasEnded) {
  begin({child("one", writes_its_number("pid") + "; trap '' TERM; exec sleep 600"), child("two", "exit 0")});
  supervisor->start_processes({});
  supervisor->stop({.code = FaultCode::operator_stop}, 0);
  EXPECT_TRUE(until([&] { return state_of(2) == ProcessState::done && !text_of("pid").empty(); }));
  supervisor->kill_all();
  EXPECT_EQ(state_of(1), ProcessState::dead);
  EXPECT_EQ(state_of(2), ProcessState::done);
  EXPECT_TRUE(mp->dead("one"));
  EXPECT_FALSE(mp->dead("two"));
  EXPECT_TRUE(until([&] { return gone("pid"); }));
}

}  // namespace
}  // namespace mrroc::mp
