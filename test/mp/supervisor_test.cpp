// The supervisor: leads a system from assembling to its end, and tells who died and why.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <random>
#include <thread>
#include <tuple>

#include "test/mp/supervised_system.hpp"

namespace mrroc::mp {
namespace {

TEST_F(SupervisorTest, LeadsASystemToItsEnd) { EXPECT_NE(hash_of_run(10, 1), 0U); }

TEST_F(SupervisorTest, FingerprintIsThatOfTheTrafficAndNotOfTheSession) {
  const std::uint64_t first = hash_of_run(10, 1);
  for (int k = 0; k < 20; ++k) EXPECT_EQ(hash_of_run(10, 1, 1000 + k), first);
  EXPECT_NE(hash_of_run(10, 2), first);
  EXPECT_NE(hash_of_run(9, 1), first);
}

TEST_F(SupervisorTest, AnUnexpectedExceptionOfANodeIsAnInternalError) {
  const auto fails = [](Process& p) {
    if (p.assemble()) throw std::runtime_error("unforeseen");
  };
  System s({{"bad", {}, {}, fails}, driver("edp")}, messages());
  s.supervisor.start_threads(s.hub);
  s.mp.assemble();
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  s.mp.report_done();
  s.supervisor.end();
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::internal_error);
  EXPECT_EQ(s.supervisor.fault()->text.view(), "unforeseen");
}

TEST_F(SupervisorTest, ADeadChildIsNoticedNamedAndDeclaredDead) {
  for (const auto& [script, how] :
       {std::pair("kill -9 $$", "signal 9 (Killed)"), std::pair("exit 3", "exit status 3")}) {
    System s({{"good", "/bin/sh", {"-c", "exec sleep 600"}, {}}, {"bad", "/bin/sh", {"-c", script}, {}}},
             messages());
    s.supervisor.start_processes({});
    EXPECT_FALSE(s.mp.assemble());
    ASSERT_TRUE(s.supervisor.fault());
    EXPECT_EQ(s.supervisor.fault()->code, FaultCode::process_died);
    EXPECT_EQ(s.supervisor.fault()->process.view(), "bad");
    EXPECT_NE(s.supervisor.fault()->text.view().find(how), std::string_view::npos);
    EXPECT_TRUE(s.await([&] { return s.mp.dead("bad"); }));
    EXPECT_FALSE(s.mp.dead("good"));
    EXPECT_EQ(s.supervisor.node_statuses()[2].state, ProcessState::dead);
    EXPECT_EQ(s.supervisor.log_hash(), 0U);
  }  // the other child ends with its supervisor
}

TEST_F(SupervisorTest, AStatusThatWasOnItsWayDoesNotReviveTheDead) {
  System s({{"bad", "/bin/sh", {"-c", "exit 3"}, {}}}, messages());
  s.supervisor.start_processes({});
  ASSERT_TRUE(s.await([&] { return s.mp.dead("bad"); }));
  link::Outbox<process_status_t> late(s.mp.bus(), s.mp.route("bad.status"), 1);
  for (const ProcessState state : {ProcessState::ready, ProcessState::running, ProcessState::done}) {
    process_status_t m{};
    m.state = static_cast<int>(state);
    late.publish(m, 0);
    for (int k = 0; k < 3; ++k) s.mp.poll();
    EXPECT_EQ(s.supervisor.node_statuses()[1].state, ProcessState::dead);
    EXPECT_TRUE(s.mp.dead("bad"));
  }
  s.mp.report_done();
  s.supervisor.end();
  EXPECT_EQ(s.supervisor.log_hash(), 0U);
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::process_died);
}

TEST_F(SupervisorTest, AProgramThatIsMissingIsSaidAtOnce) {
  System s({{"part", "/no/such/program", {}, {}}}, messages());
  EXPECT_THROW(s.supervisor.start_processes({}), FaultError);
}

TEST_F(SupervisorTest, TheFirstReasonIsKeptAndADeathDoesNotWaitForTheAgreedMacrostep) {
  System s({}, messages());
  EXPECT_TRUE(s.mp.assemble());
  s.supervisor.stop({.code = FaultCode::operator_stop}, 1000);
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  EXPECT_EQ(s.mp.stop_as_of(), 1000);
  s.supervisor.stop({.code = FaultCode::process_died}, 0);
  EXPECT_TRUE(s.await([&] { return s.mp.stop_as_of() == 0; }));
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::operator_stop);
  s.supervisor.stop({.code = FaultCode::operator_stop}, 2000);
  s.mp.poll();
  EXPECT_EQ(s.mp.stop_as_of(), 0);
}

TEST_F(SupervisorTest, LinesOfAllProcessesAreWrittenDown) {
  const auto talks = [](Process& p) {
    p.log("hello there");
    p.log("that hurt", FaultCode::not_at_rest);
    if (p.assemble()) p.report_done();
  };
  System s({{"talker", {}, {}, talks}}, messages());
  s.supervisor.start_threads(s.hub);
  s.mp.assemble();
  s.mp.report_done();
  s.supervisor.end();
  EXPECT_EQ(s.supervisor.last_message(), "talker: that hurt");
  const std::string text = logged();
  EXPECT_NE(text.find("hello there"), std::string::npos);
  EXPECT_NE(text.find("not_at_rest"), std::string::npos);
}

TEST_F(SupervisorTest, DestructionEndsThreadsThatStillWait) {
  System s({{"one", {}, {}, counts(1000)}}, messages());
  s.supervisor.start_threads(s.hub);
  EXPECT_TRUE(s.mp.assemble());
}

TEST_F(SupervisorTest, ANodeThatIsDoneBeforeTheTasksProgramIsEndsTheRunWithAFaultThatNamesIt) {
  System s({{"early", {}, {}, counts(3)}, {"two", {}, {}, counts(10)}}, messages());
  s.supervisor.start_threads(s.hub);
  ASSERT_TRUE(s.mp.assemble());
  s.run(3);
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::ended_early);
  EXPECT_EQ(s.supervisor.fault()->process.view(), "early");
  s.mp.report_done();
  s.supervisor.end();
}

TEST_F(SupervisorTest, AChildThatLeavesWithStatusZeroWhileTheSystemRunsHasEndedEarly) {
  System s({{"leaves", "/bin/true", {}, {}}, {"good", "/bin/sh", {"-c", "exec sleep 600"}, {}}}, messages());
  s.supervisor.start_processes({});
  EXPECT_FALSE(s.mp.assemble());
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::ended_early);
  EXPECT_EQ(s.supervisor.fault()->process.view(), "leaves");
}

TEST_F(SupervisorTest, ANodeThatHasNotToldWhatItSentIsNamed) {
  const auto says_nothing = [](Process& p) {
    if (p.assemble()) p.report_done();  // without links
    p.stay();
  };
  System s({{"one", {}, {}, counts(2)}, {"mute", {}, {}, says_nothing}}, messages());
  s.supervisor.start_threads(s.hub);
  ASSERT_TRUE(s.mp.assemble());
  EXPECT_EQ(s.supervisor.without_fingerprint(), "mp");
  s.run(2);
  s.mp.report_done();
  s.supervisor.end();
  EXPECT_FALSE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.without_fingerprint(), "mute");
}

TEST_F(SupervisorTest, LastWordsThatNobodyHasLookedAtBeforeTheEndAreHeard) {
  std::atomic<bool> said{};
  const auto leaves = [&](Process& p) {
    p.assemble();
    p.report_done();
    said = true;
  };
  System s({{"one", {}, {}, leaves}}, messages());
  s.supervisor.start_threads(s.hub);
  ASSERT_TRUE(s.mp.assemble());
  s.supervisor.stop({.code = FaultCode::time_limit}, 0);
  while (!said) std::this_thread::yield();
  std::this_thread::sleep_for(std::chrono::milliseconds(20));  // its thread ends
  s.mp.report_done();
  s.supervisor.end();
  EXPECT_EQ(s.supervisor.node_statuses()[1].state, ProcessState::done);
}

TEST_F(SupervisorTest, AStatusThatComesLateRevivesNobody) {
  System s({{"one", {}, {}, counts(3)}}, messages());
  link::Outbox<process_status_t> late(s.mp.bus(), s.mp.route("one.status"), 1);
  late.publish(status(ProcessState::done, link::Phase::running), 0);
  late.publish(status(ProcessState::running, link::Phase::running), 0);
  s.mp.poll();
  EXPECT_EQ(s.supervisor.node_statuses()[1].state, ProcessState::done);
}

TEST_F(SupervisorTest, RandomStatusesOfAStrangerDoNoHarm) {
  System s({{"one", {}, {}, counts(3)}}, messages());
  link::Outbox<process_status_t> stranger(s.mp.bus(), s.mp.route("one.status"), 1);
  std::mt19937_64 random(3);
  s.mp.report_done();
  for (int k = 0; k < 200; ++k) {
    process_status_t m{};
    const auto number = [&] { return static_cast<std::int32_t>(random()); };
    m.state = k % 3 == 0 ? number() : static_cast<int>(ProcessState::done);
    m.n_hashes = number();
    m.fault.code = number();
    m.skipped = static_cast<std::int64_t>(random());
    for (auto& h : m.hash)
      for (auto& c : h.channel) c = static_cast<std::int8_t>(random());
    if (m.state == static_cast<int>(ProcessState::faulted)) continue;
    stranger.publish(m, 0);
    s.mp.poll();
    for (const NodeStatus& p : s.supervisor.node_statuses()) EXPECT_LE(p.state, ProcessState::dead);
    std::ignore = s.supervisor.log_hash();
  }
  EXPECT_FALSE(s.supervisor.fault());
}

}  // namespace
}  // namespace mrroc::mp
