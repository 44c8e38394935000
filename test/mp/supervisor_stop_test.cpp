// The supervisor stops a system: nodes rest and confirm, and those that do not are ended.
#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <future>

#include "test/mp/supervised_system.hpp"

namespace mrroc::mp {
namespace {

TEST_F(SupervisorTest, AFaultOfANodeStopsTheSystemAndIsTold) {
  const auto fails = [](Process& p) {
    if (p.assemble()) throw FaultError({.code = FaultCode::over_current, .axis = 2});
  };
  System s({{"good", {}, {}, counts(10)}, {"bad", {}, {}, fails}, driver("edp")}, messages());
  s.supervisor.start_threads(s.hub);
  EXPECT_TRUE(s.mp.assemble());
  EXPECT_TRUE(s.await([&] { return s.mp.over(); }));
  s.mp.report_done();
  s.supervisor.end();
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::over_current);
  EXPECT_EQ(s.supervisor.fault()->axis, 2);
  EXPECT_EQ(s.supervisor.fault()->process.view(), "bad");
  EXPECT_NE(logged().find("over_current"), std::string::npos);
}

TEST_F(SupervisorTest, AfterAStopItWaitsUntilEveryDriverThatLivesSaysThatItsRobotRests) {
  const auto fails = [](Process& p) {
    p.report_effector(0);
    if (p.assemble()) throw std::runtime_error("unforeseen");
  };
  System s(
      {driver("quick", {}, 30), driver("slow", std::chrono::milliseconds(300), 70), {"dead", {}, {}, fails}},
      messages());
  const auto took = s.end_when_it_stops();
  EXPECT_GE(took, std::chrono::milliseconds(250)) << "it waits for the slow one";
  EXPECT_LT(took, std::chrono::seconds(10)) << "and not for the dead one";
  EXPECT_EQ(s.supervisor.stop_steps(), 70);
}

// What the driver has told of its rest before is of another time.
TEST_F(SupervisorTest, OfADriverThatIsDeadThePlantTellsWhenItsRobotRests) {
  const auto simulates = [](Process& p) {
    p.assemble();
    p.await([&] { return p.over() && p.dead("edp"); });
    p.await([&] { return p.phase() == link::Phase::finished; },
            Process::Clock::now() + std::chrono::milliseconds(300));
    p.report_rest(true, 12);
    p.report_done();
    p.stay();
  };
  for (const bool rested : {false, true}) {
    const auto dies = [rested](Process& p) {
      p.report_effector(0);
      if (rested) p.report_rest(true, 3);
      if (p.assemble()) throw std::runtime_error("unforeseen");
    };
    System s({{.name = "edp", .body = dies, .plant = "plant"}, {.name = "plant", .body = simulates}},
             messages());
    s.end_when_it_stops();
    EXPECT_EQ(s.supervisor.stop_steps(), 12) << "it waited for what the plant tells later: " << rested;
  }
}

TEST_F(SupervisorTest, ADeadDriverIsNotWaitedForWhenItsPlantIsDeadToo) {
  const auto dies = [](Process& p) {
    p.report_effector(0);
    if (p.assemble()) throw std::runtime_error("unforeseen");
  };
  System s({{.name = "edp", .body = dies, .plant = "plant"}, {.name = "plant", .body = dies}}, messages());
  EXPECT_LT(s.end_when_it_stops(), std::chrono::seconds(10));
  EXPECT_EQ(s.supervisor.stop_steps(), std::nullopt);
}

TEST_F(SupervisorTest, AThreadThatDoesNotEndIsNamedAndDoesNotHoldUpTheEnd) {
  const auto hangs = [](Process& p) {
    p.assemble();
    std::promise<void>().get_future().wait();
  };
  const auto run = [&] {
    System s({{"stuck", {}, {}, hangs}, driver("edp")}, messages(), 1,
             {.leave = std::chrono::milliseconds(50)});
    s.supervisor.start_threads(s.hub);
    s.mp.assemble();
    s.supervisor.stop({.code = FaultCode::operator_stop}, 0);
    s.mp.report_done();
    s.supervisor.end();
  };
  EXPECT_EXIT(run(), testing::ExitedWithCode(exit_status(FaultCode::process_hung)), "");
  EXPECT_NE(logged().find("the thread stuck does not end"), std::string::npos) << logged();
  EXPECT_NE(logged().find("  stuck  "), std::string::npos) << "under its own name: " << logged();
}

TEST_F(SupervisorTest, ANodeThatDoesNotConfirmAStopIsNamedAndEndedAndTheOthersAreLeftToRest) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  const fs::path number = folder_ / "number";  // of the process of `deaf`
  System s({{"good", "/bin/sh", {"-c", "exec sleep 600"}, {}},
            {"deaf",
             "/bin/sh",
             {"-c", "echo $$ > " + number.string() + "; trap '' TERM; while :; do sleep 0.1; done"},
             {}}},
           messages());
  std::vector<std::string> alarms;
  s.supervisor.on_alarm = [&](const std::string& line) { alarms.push_back(line); };
  s.supervisor.start_processes({});
  link::Outbox<process_status_t> good(s.mp.bus(), s.mp.route("good.status"), 1);
  link::Outbox<process_status_t> deaf(s.mp.bus(), s.mp.route("deaf.status"), 1);
  good.publish(status(ProcessState::ready, link::Phase::assembling), 0);
  deaf.publish(status(ProcessState::ready, link::Phase::assembling), 0);
  ASSERT_TRUE(s.mp.assemble());
  EXPECT_FALSE(s.supervisor.stop_confirmed()) << "nobody has stopped anything";
  s.supervisor.stop({.code = FaultCode::operator_stop}, 0);
  EXPECT_FALSE(s.supervisor.stop_confirmed());
  good.publish(status(ProcessState::running, link::Phase::stopping), 0);
  deaf.publish(status(ProcessState::running, link::Phase::running), 0);
  const auto begun = Process::Clock::now();
  EXPECT_TRUE(s.await([&] { return s.supervisor.node_statuses()[2].state == ProcessState::dead; }));
  const auto lasted = Process::Clock::now() - begun;
  EXPECT_GE(lasted, StopEscalation::kConfirm);
  EXPECT_LT(lasted, StopEscalation::kConfirm + StopEscalation::kTerminate + std::chrono::seconds(2));
  EXPECT_EQ(s.supervisor.unconfirmed(), "deaf");
  EXPECT_EQ(s.supervisor.node_statuses()[1].state, ProcessState::running);
  EXPECT_TRUE(s.supervisor.stop_confirmed());
  ASSERT_TRUE(s.supervisor.fault());
  EXPECT_EQ(s.supervisor.fault()->code, FaultCode::stop_not_confirmed);
  EXPECT_EQ(exit_status(s.supervisor.fault()->code), 3);
  ASSERT_EQ(alarms.size(), 2U);
  EXPECT_EQ(alarms[0], "deaf has not confirmed the stop in 3.0 s: SIGTERM");
  EXPECT_EQ(alarms[1], "deaf does not end by SIGTERM either: SIGKILL");
  EXPECT_NE(logged().find(alarms[1]), std::string::npos) << logged();
  int pid = 0;
  ASSERT_TRUE(std::ifstream(number) >> pid);
  EXPECT_TRUE(
      s.mp.await([&] { return ::kill(pid, 0) != 0; }, Process::Clock::now() + std::chrono::seconds(2)))
      << "it lives";
}

TEST_F(SupervisorTest, ASecondWordShortensAndAThirdKills) {
  if (kNoDeadlines) GTEST_SKIP() << "under sanitizers nobody is ended for being slow";
  System s(
      {{"deaf", "/bin/sh", {"-c", "exec sleep 600"}, {}}, {"other", "/bin/sh", {"-c", "exec sleep 600"}, {}}},
      messages());
  s.supervisor.start_processes({});
  s.supervisor.stop({.code = FaultCode::operator_stop}, 0);
  s.supervisor.hurry();
  const auto begun = Process::Clock::now();
  EXPECT_TRUE(s.await([&] { return s.supervisor.node_statuses()[1].state == ProcessState::dead; }));
  EXPECT_LT(Process::Clock::now() - begun, StopEscalation::kConfirm);
  System other({{"one", "/bin/sh", {"-c", "trap '' TERM; exec sleep 600"}, {}}}, messages());
  other.supervisor.start_processes({});
  other.supervisor.stop({.code = FaultCode::operator_stop}, 0);
  other.supervisor.kill_all();
  EXPECT_EQ(other.supervisor.node_statuses()[1].state, ProcessState::dead);
}

}  // namespace
}  // namespace mrroc::mp
