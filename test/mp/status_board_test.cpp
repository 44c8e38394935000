// The agents' status for terminals: each agent reports its behaviour itself, at any moment, and the board
// passes it on.
#include "mp/status_board.hpp"

#include <gtest/gtest.h>

#include <thread>
#include <tuple>

#include "base/link/memory_bus.hpp"
#include "base/link/text.hpp"

namespace mrroc::mp {
namespace {

/// MP and the ECP of arm1, in one thread.
struct System {
  /// @param with_effector  agents that the board is told
  explicit System(const std::vector<std::string>& with_effector = {"arm1", "arm2"})
      : board(mp, supervisor, "press", with_effector, "/runs/press") {}
  static link::NodeContext context_of(const std::string& name) {
    return {.session = "test", .session_id = 1, .name = name, .roster = {"mp", "ecp-arm1"}};
  }
  task_status_t told() {
    while (mp_bus->wait(std::chrono::milliseconds(0))) {
    }
    supervisor.poll();
    board.poll();
    while (terminal->wait(std::chrono::milliseconds(0))) {
    }
    return *statuses.newest();
  }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> mp_bus{hub.open()}, ecp_bus{hub.open()}, terminal{hub.open()};
  link::Process mp{*mp_bus, context_of("mp")}, ecp{*ecp_bus, context_of("ecp-arm1")};
  Supervisor supervisor{mp, {NodeSpec{"ecp-arm1", {}, {}, {}, {}}}, "/dev/null"};
  StatusBoard board;
  link::Inbox<task_status_t> statuses{*terminal, {link::Group::agents, "test.task_status"}, 1};
};

TEST(StatusBoard, TellsTheBehaviourOfEveryAgentAndWhyTheOneBeforeEnded) {
  System s;
  s.ecp.in_behaviour(1, "approach", "F_z above 3.6 N");
  task_status_t m = s.told();
  EXPECT_EQ(m.agent_m[0], 1);
  EXPECT_EQ(link::get_text(m.agent_behaviour[0]), "approach");
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "");
  EXPECT_EQ(link::get_text(m.agent_behaviour[1]), "") << "arm2 has told none";
  s.ecp.report_progress(62, 0);
  s.ecp.in_behaviour(2, "settle");
  m = s.told();  // at once, not with the next period
  EXPECT_EQ(m.agent_m[0], 2);
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "approach: F_z above 3.6 N");
  s.ecp.report_progress(100, 0);
  s.ecp.in_behaviour(0, "done");
  m = s.told();
  EXPECT_EQ(link::get_text(m.agent_behaviour[0]), "done");
  EXPECT_EQ(link::get_text(m.agent_ended_because[0]), "settle, ended after 38 macrosteps");
}

TEST(StatusBoard, TellsWhatKindOfEffectorAnAgentHas) {
  System s;
  s.board.set_effector(1, EffectorKind::platform);
  s.board.set_effector(99, EffectorKind::platform);
  s.board.publish();
  const task_status_t m = s.told();
  EXPECT_EQ(m.effector[0], static_cast<int>(EffectorKind::arm));
  EXPECT_EQ(m.effector[1], static_cast<int>(EffectorKind::platform));
}

TEST(StatusBoard, TellsAnAgentWithoutAnEffectorBehindTheOthers) {
  System s{{"rex"}};
  s.ecp.in_behaviour(2, "position lost", "a plausible reading comes");
  task_status_t m = s.told();
  ASSERT_EQ(m.n_agents, 2);
  EXPECT_EQ(link::get_text(m.agent[0]), "rex");
  EXPECT_EQ(link::get_text(m.agent[1]), "arm1");
  EXPECT_EQ(m.effector[1], static_cast<int>(EffectorKind::none));
  EXPECT_EQ(m.agent_m[1], 2);
  EXPECT_EQ(link::get_text(m.agent_behaviour[1]), "position lost");
  EXPECT_EQ(s.told().n_agents, 2) << "once";
}

TEST(StatusBoard, LeavesOutAnAgentThatTheMessageHasNoRoomFor) {
  System s{{"a", "b", "c", "d"}};
  EXPECT_EQ(s.told().n_agents, 4);
}

TEST(StatusBoard, TellsTheVelocityOfAPlatform) {
  System s;
  s.board.set_velocity(1, {0.5, -0.01, 0.25});
  s.board.set_velocity(99, {1, 1, 1});
  const task_status_t m = s.told();
  EXPECT_EQ(m.velocity[0][0], 0);
  EXPECT_EQ(m.velocity[1][0], 0.5);
  EXPECT_EQ(m.velocity[1][1], -0.01);
  EXPECT_EQ(m.velocity[1][2], 0.25);
}

TEST(StatusBoard, SaysWhyTheCoordinatorsBehaviourEndedOrHowLongItLasted) {
  System s;
  s.board.set_time(10, 0.2);
  s.board.set_behaviour(0, "wait for start", "start given");
  EXPECT_EQ(link::get_text(s.told().ended_because), "");
  s.board.set_behaviour(1, "approach", "");
  EXPECT_EQ(link::get_text(s.told().ended_because), "wait for start: start given");
  s.board.set_time(85, 1.7);
  s.board.set_behaviour(1, "approach", "");
  s.board.set_behaviour(2, "settle", "");
  EXPECT_EQ(link::get_text(s.told().ended_because), "approach, ended after 1.50 s");
}

TEST(StatusBoard, ARunIsSeenToGoOnWhileADriverHomesAndWhenADriverChanges) {
  System s;
  Report r;
  const auto watched_in = [&](std::int64_t i, DriverState state) {
    s.board.set_time(i, 0.02 * static_cast<double>(i));
    r.driver_state = state;
    s.board.set_arm(1, r, "");
    return s.board.watched();
  };
  EXPECT_NE(watched_in(1, DriverState::homing), watched_in(2, DriverState::homing));
  EXPECT_EQ(watched_in(1, DriverState::ready), watched_in(2, DriverState::ready))
      << "time alone is no change";
  EXPECT_NE(watched_in(2, DriverState::ready), watched_in(2, DriverState::executing));
}

TEST(StatusBoard, TellsTheTaskItsArmsAndItsProcesses) {
  System s;
  s.board.set_time(50, 1);
  s.board.set_state(TaskState::running, true);
  s.board.set_early("the pen is in the air");
  s.board.set_progress(0.25, "stroke 1 of 4");
  Report r;
  r.position_known = true;
  r.T_0E = {1, 2, 3, 4, 5, 6};
  for (std::size_t k = 0; k < 6; ++k) r.F_a.v[k] = 10 + static_cast<double>(k);
  r.sensor = 2;
  s.board.set_arm(1, r, "on paper");
  s.board.set_behaviour(3, "draw", "");
  s.supervisor.stop({.code = FaultCode::operator_stop}, 0);
  s.board.publish();
  const task_status_t m = s.told();
  EXPECT_EQ(m.header.stamp, 50);
  EXPECT_EQ(link::get_text(m.task), "press");
  EXPECT_EQ(link::get_text(m.run_folder), "/runs/press");
  EXPECT_EQ(m.n_agents, 2);
  EXPECT_EQ(link::get_text(m.agent[0]), "arm1");
  EXPECT_EQ(link::get_text(m.agent[1]), "arm2");
  EXPECT_EQ(m.state, static_cast<int>(TaskState::running));
  EXPECT_EQ(m.waits_for_trigger, 1);
  EXPECT_EQ(link::get_text(m.early), "the pen is in the air");
  EXPECT_EQ(m.progress, 0.25);
  EXPECT_EQ(link::get_text(m.progress_text), "stroke 1 of 4");
  EXPECT_EQ(m.m, 3);
  EXPECT_EQ(m.sim_time, 1);
  for (std::size_t k = 0; k < 6; ++k) {
    EXPECT_EQ(m.T_0E[1][k], r.T_0E[k]);
    EXPECT_EQ(m.F_a[1][k], r.F_a.v[k]);
    EXPECT_EQ(m.F_a[0][k], 0);
  }
  EXPECT_EQ(m.position_known[1], 1);
  EXPECT_EQ(m.position_known[0], 0);
  EXPECT_EQ(m.sensor[1], 2);
  EXPECT_EQ(link::get_text(m.sensor_text[1]), "on paper");
  ASSERT_EQ(m.n_processes, 2);
  EXPECT_EQ(link::get_text(m.process[1]), "ecp-arm1");
  EXPECT_GE(m.process_age[1], 0);
  EXPECT_LT(m.process_age[1], 60);
  EXPECT_EQ(m.last_code, static_cast<int>(FaultCode::operator_stop));
  EXPECT_NE(link::get_text(m.last_message), "");
}

TEST(StatusBoard, AProcessIsShownWithTheTimeSinceItWasHeard) {
  System s;
  s.ecp.in_behaviour(1, "approach");
  std::ignore = s.told();
  constexpr std::chrono::milliseconds kSilent{200};
  std::this_thread::sleep_for(kSilent);
  s.board.publish();
  const task_status_t silent = s.told();
  EXPECT_GE(silent.process_age[1], std::chrono::duration<double>(kSilent).count());
  s.ecp.in_behaviour(2, "settle");
  EXPECT_LT(s.told().process_age[1], silent.process_age[1]) << "it has just been heard";
}

TEST(StatusBoard, SpeedIsThatOfTheSimulatedTime) {
  System s;
  s.board.set_time(0, 0);
  s.board.publish();
  double sim = 0;
  for (int k = 0; k < 40; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
    sim += 0.25;
    s.board.set_time(k, sim);
    s.board.publish();
  }
  const double speed = s.told().speed;
  EXPECT_GT(speed, 1) << "ten times as fast as the clock, as far as this host keeps to it";
  EXPECT_LT(speed, 11);
}

TEST(StatusBoard, WhatWasSetCanBeAsked) {
  System s;
  EXPECT_EQ(s.board.m(), 0);
  EXPECT_EQ(s.board.behaviour(), "");
  s.board.set_behaviour(3, "draw", "the stroke has ended");
  s.board.set_progress(0.5, "half");
  EXPECT_EQ(s.board.m(), 3);
  EXPECT_EQ(s.board.behaviour(), "draw");
  EXPECT_EQ(s.board.until(), "the stroke has ended");
  EXPECT_EQ(s.board.progress(), 0.5);
  s.board.set_behaviour(4, "lift", "the pen is up");
  EXPECT_EQ(s.board.until(), "the pen is up");
  s.board.set_behaviour(3, "draw", "the stroke has ended");
  const std::string before = s.board.watched();
  s.board.set_time(99, 9);
  EXPECT_EQ(s.board.watched(), before);
  s.board.set_progress(0.6, "half");
  EXPECT_NE(s.board.watched(), before);
  s.board.set_progress(0.5, "half");
  s.board.set_behaviour(4, "draw", "");
  EXPECT_NE(s.board.watched(), before);
}

TEST(StatusBoard, ABehaviourIsAnotherOneByItsNumberOrByItsName) {
  System s;
  s.board.set_behaviour(1, "approach", "contact");
  s.board.set_behaviour(2, "approach", "force");
  EXPECT_EQ(link::get_text(s.told().ended_because), "approach: contact");
  s.board.set_behaviour(2, "hold", "time");
  const task_status_t m = s.told();
  EXPECT_EQ(link::get_text(m.ended_because), "approach: force");
  EXPECT_EQ(link::get_text(m.behaviour), "hold");
  EXPECT_EQ(m.m, 2);
}

TEST(StatusBoard, NewsAreToldAtOnceAndWhatIsNotNewTenTimesASecond) {
  System s;
  link::Queue<task_status_t> all(*s.terminal, {link::Group::agents, "test.task_status"}, 1);
  const auto told = [&] {
    while (s.mp_bus->wait(std::chrono::milliseconds(0))) {
    }
    s.supervisor.poll();
    s.board.poll();
    while (s.terminal->wait(std::chrono::milliseconds(0))) {
    }
    int n = 0;
    while (all.take()) ++n;
    return n;
  };
  std::ignore = told();
  const auto then = link::Process::Clock::now();
  int times = 0;
  while (link::Process::Clock::now() - then < std::chrono::milliseconds(320)) times += told();
  EXPECT_LE(times, (link::Process::Clock::now() - then) / std::chrono::milliseconds(100) + 1);
  EXPECT_GE(times, 1);
  s.board.publish();
  std::ignore = told();
  for (int k = 1; k <= 20; ++k) {  // in much less than twenty periods
    s.board.set_behaviour(k, "next", "");
    EXPECT_EQ(told(), 1);
    s.ecp.in_behaviour(k, "its own");
    EXPECT_EQ(told(), 1);
  }
  const auto since = link::Process::Clock::now();
  int repeated = 0;
  for (int k = 0; k < 20; ++k) repeated += told();
  EXPECT_LE(repeated, (link::Process::Clock::now() - since) / std::chrono::milliseconds(100) + 1)
      << "old news";
}

TEST(StatusBoard, AStatusHasTheStampOfItsMacrostep) {
  System s;
  for (const std::int64_t macrostep : {5, 7}) {
    s.board.set_time(macrostep, 0.02 * static_cast<double>(macrostep));
    s.board.publish();
    EXPECT_EQ(s.told().header.stamp, macrostep);
  }
}

TEST(StatusBoard, AProcessIsShownWithItsStateAndAFaultWithItsCode) {
  System s;
  task_status_t m = s.told();
  EXPECT_EQ(link::get_text(m.process[0]), "mp");
  EXPECT_EQ(m.process_state[1], static_cast<int>(link::ProcessState::starting));
  EXPECT_EQ(m.fault, 0);
  EXPECT_EQ(m.last_code, 0);
  s.ecp.report_fault({.code = FaultCode::over_current});
  std::ignore = s.told();
  s.board.publish();
  m = s.told();
  EXPECT_EQ(m.process_state[1], static_cast<int>(link::ProcessState::faulted));
  EXPECT_EQ(m.fault, static_cast<int>(FaultCode::over_current));
  EXPECT_EQ(m.last_code, static_cast<int>(FaultCode::over_current));
  EXPECT_TRUE(link::get_text(m.last_message).starts_with("ecp-arm1: ")) << link::get_text(m.last_message);
}

TEST(StatusBoard, MoreArmsAndProcessesThanThereIsRoomForAreLeftOut) {
  link::MemoryHub hub;
  const auto bus = hub.open(), terminal = hub.open();
  link::NodeContext me{.session = "test", .session_id = 1, .name = "mp", .roster = {"mp"}};
  std::vector<NodeSpec> nodes;
  std::vector<std::string> arms;
  for (int k = 0; k < 30; ++k) {
    nodes.push_back({"part" + std::to_string(k), {}, {}, {}, {}});
    arms.push_back("arm" + std::to_string(k));
    me.roster.push_back(nodes.back().name);
  }
  link::Process mp(*bus, me);
  const Supervisor supervisor(mp, nodes, "/dev/null");
  StatusBoard board(mp, supervisor, "press", arms, "");
  link::Inbox<task_status_t> statuses(*terminal, {link::Group::agents, "test.task_status"}, 1);
  board.publish();
  while (terminal->wait(std::chrono::milliseconds(0))) {
  }
  const task_status_t m = *statuses.newest();
  ASSERT_EQ(m.n_agents, 4);
  EXPECT_EQ(link::get_text(m.agent[3]), "arm3");
  ASSERT_EQ(m.n_processes, 16);
  EXPECT_EQ(link::get_text(m.process[15]), "part14");
}

TEST(StatusBoard, AfterASecondTheSpeedIsThatOfTheSecond) {
  using Clock = link::Process::Clock;
  System s;
  s.board.set_time(0, 5);
  const auto before = Clock::now();
  s.board.publish();
  const auto first = Clock::now();
  std::this_thread::sleep_for(std::chrono::milliseconds(1010));
  s.board.set_time(50, 15);
  const auto second = Clock::now();
  s.board.publish();
  const auto after = Clock::now();
  while (s.terminal->wait(std::chrono::milliseconds(0))) {
  }
  const double speed = s.statuses.newest()->speed;
  EXPECT_GE(speed, 10 / std::chrono::duration<double>(after - before).count() - 1e-9);
  EXPECT_LE(speed, 10 / std::chrono::duration<double>(second - first).count() + 1e-9);
}

}  // namespace
}  // namespace mrroc::mp
