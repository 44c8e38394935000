// An arm's links by message: what a macrostep waits for, and what it takes when something is missing.
#include "ecp/effector_links.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "base/agent_images.hpp"
#include "base/link/text.hpp"
#include "ecp/solo.hpp"
#include "test/ecp/effector_links_fixture.hpp"

namespace mrroc::ecp {
namespace {

using link::Phase;

using test::ArmLinksTest;

TEST_F(ArmLinksTest, EveryMacrostepHasItsOwnImages) {
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  for (std::int64_t i = 1; i <= 5; ++i) {
    EXPECT_EQ(links->i(), i);
    EXPECT_EQ(links->reply().gripper, static_cast<double>(i));
    EXPECT_EQ(links->order().m, i);
    EXPECT_FALSE(links->order().late);
    EXPECT_EQ(links->reading().state, i);
    if (i == 1) reply(2);
    reply(i + 2);  // the driver is one ahead
    order(i + 1);
    read(i + 1);
    ASSERT_EQ(links->wait(), Outcome::terminated);
  }
}

TEST_F(ArmLinksTest, CommandAndReportAreForTheNextMacrostep) {
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  EXPECT_EQ(sent().header.stamp, 1);
  links->send({.instruction = Instruction::set_get}, {.m = 4});
  const effector_command_t command = sent();
  EXPECT_EQ(command.header.stamp, 2);
  EXPECT_EQ(command.instruction, static_cast<int>(Instruction::set_get));
  std::ignore = reports->take();
  const auto report = reports->take();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->header.stamp, 2);
  EXPECT_EQ(report->m, 4);
}

TEST_F(ArmLinksTest, WhatComesEarlyWaitsForItsMacrostep) {
  for (const ClockKind clock : {ClockKind::step, ClockKind::wall}) {
    begin(clock);
    all(1);
    ASSERT_EQ(links->begin(), Outcome::terminated);
    for (std::int64_t i = 2; i <= 5; ++i) {
      order(i);
      read(i);
    }
    for (std::int64_t i = 2; i <= 5; ++i) {
      reply(i);
      ASSERT_EQ(links->wait(), Outcome::terminated);
      EXPECT_EQ(links->order().m, i);
      EXPECT_EQ(links->reading().state, i);
      EXPECT_FALSE(links->order().late);
    }
  }
}

TEST_F(ArmLinksTest, ACommandThatHasBeenAnsweredIsSettled) {
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  links->send({.instruction = Instruction::set_get}, {});
  all(2);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_FALSE(links->client().settled());
  EffectorReply r = told(3);
  r.verdict = Verdict::executed;
  r.number = 1;
  reply(3, r);
  order(3);
  read(3);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_TRUE(links->client().settled());
}

// In lock-step what the driver has not seen is lost; by the wall clock it may have been late, for a time.
TEST_F(ArmLinksTest, ACommandThatIsNeverAnsweredIsSentAgainAndThenAFault) {
  for (const auto& [clock, sendings] : {std::pair(ClockKind::step, 3), std::pair(ClockKind::wall, 50)}) {
    begin(clock);
    all(1);
    ASSERT_EQ(links->begin(), Outcome::terminated);
    links->send({.instruction = Instruction::synchro}, {});
    Outcome o = Outcome::terminated;
    for (std::int64_t i = 2; i < 1000 && o == Outcome::terminated; ++i) {
      all(i);
      o = links->wait();
      if (o == Outcome::terminated) links->send({}, {});
    }
    EXPECT_EQ(o, Outcome::faulted);
    ASSERT_TRUE(links->client().fault());
    EXPECT_EQ(links->client().fault()->code, FaultCode::command_repeated_refused);
    int times = 0;
    for (effector_command_t c = sent(); c.header.stamp != 0; c = sent())
      if (c.instruction == static_cast<int>(Instruction::synchro)) ++times;
    EXPECT_EQ(times, sendings);
  }
}

TEST_F(ArmLinksTest, TheBehaviourAndWhyTheOneBeforeEndedAreTold) {
  begin(ClockKind::step);
  link::Inbox<process_status_t> status(*others, process->route("ecp-arm1.status"), 1);
  links->in_behaviour(3, "press", "contact is made");
  links->in_behaviour(4, "hold", "");
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  ASSERT_TRUE(status.newest());
  EXPECT_EQ(status.newest()->m, 4);
  EXPECT_EQ(link::get_text(status.newest()->behaviour), "hold");
  EXPECT_EQ(link::get_text(status.newest()->ended_because), "press: contact is made");
}

// So that runs can be compared, and that a driver tells the agents of two arms apart.
TEST_F(ArmLinksTest, TheOwnerOfAnEffectorIsTheSameInEveryRunAndAnotherForAnotherProcess) {
  std::vector<std::int64_t> owners;
  for (const char* const name : {"ecp-arm1", "ecp-arm1", "ecp-arm2", "manual"}) {
    name_ = name;
    begin(ClockKind::step);
    links->send({.instruction = Instruction::set_get}, {});
    owners.push_back(from_message(sent()).session);
    EXPECT_GT(owners.back(), 0);
  }
  EXPECT_EQ(owners[0], owners[1]);
  EXPECT_NE(owners[0], owners[2]);
  EXPECT_NE(owners[0], owners[3]);
  EXPECT_NE(owners[2], owners[3]);
}

TEST_F(ArmLinksTest, InLockStepNothingGoesOnWithoutOneOfTheImages) {
  for (int missing = 0; missing < 4; ++missing) {
    EffectorLinkNames names{.robot = "arm1", .sensor = "arm1.sensor"};
    names.others.here = [&](std::int64_t i, std::int64_t step) {
      return missing != 3 && i == 1 && step == 30;
    };
    begin(ClockKind::step, names, std::chrono::milliseconds(50));
    EffectorReply r = told(1);
    r.step = 30;
    if (missing != 0) reply(1, r);
    if (missing != 1) order(1);
    if (missing != 2) read(1);
    FaultCode code{};
    try {
      std::ignore = links->begin();
    } catch (const FaultError& e) {
      code = e.fault().code;
    }
    EXPECT_EQ(code, FaultCode::peer_silent) << missing;
  }
}

TEST_F(ArmLinksTest, AnAgentWithoutASensorWaitsForNone) {
  begin(ClockKind::step, {.robot = "arm1", .sensor = ""});
  reply(1);
  order(1);
  EXPECT_EQ(links->begin(), Outcome::terminated);
  EXPECT_EQ(links->reading().state, 0);
}

TEST_F(ArmLinksTest, WithTheWallClockTheNewestReplySetsThePace) {
  begin(ClockKind::wall);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  for (std::int64_t i = 2; i <= 7; ++i) reply(i);
  order(2);
  order(9);
  read(3);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 7);
  EXPECT_EQ(links->reply().gripper, 7);
  EXPECT_EQ(links->reading().state, 3) << "as it was";
  EXPECT_EQ(links->order().m, 9) << "the newest";
  EXPECT_FALSE(links->order().late);
  reply(10);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  EXPECT_EQ(links->i(), 10);
  EXPECT_TRUE(links->order().late) << "9 is older than 10";
  link::Inbox<process_status_t> status(*others, process->route("ecp-arm1.status"), 1);
  process->report_done();
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  ASSERT_TRUE(status.newest());
  EXPECT_EQ(status.newest()->skipped, 5 + 2) << "2 to 6, and 8 and 9";
  EXPECT_EQ(status.newest()->macrostep, 10);
}

TEST_F(ArmLinksTest, TheSensorsSettingGoesOutInEveryMacrostepAndStaysUntilAnotherOne) {
  begin(ClockKind::step);
  link::Queue<link::MessageOf<SensorSetting>> settings(*others, process->route("arm1.sensor.setting"), 1);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  SensorSetting setting;
  setting.value[0] = 7;
  links->set_sensor(setting);
  links->send({}, {});
  links->send({}, {});
  while (others->wait(std::chrono::milliseconds(0))) {
  }
  const double expected[]{0, 7, 7};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto m = settings.take();
    ASSERT_TRUE(m) << k;
    EXPECT_EQ(m->header.stamp, k == 0 ? 1 : 2);
    EXPECT_EQ(from_message(*m).value[0], expected[k]) << k;
  }
}

TEST_F(ArmLinksTest, AtItsEndReleasesTheArmReportsThatItIsReadyAndEndsItsSetting) {
  begin(ClockKind::step);
  link::Queue<link::MessageOf<SensorSetting>> settings(*others, process->route("arm1.sensor.setting"), 1);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  links->end();
  effector_command_t last = sent();
  EXPECT_EQ(last.instruction, static_cast<int>(Instruction::keep));
  last = sent();
  EXPECT_EQ(last.instruction, static_cast<int>(Instruction::release));
  EXPECT_EQ(last.header.stamp, 2);
  EXPECT_FALSE(reports->take()->ready);
  const auto report = reports->take();
  ASSERT_TRUE(report);
  EXPECT_TRUE(report->ready);
  EXPECT_EQ(report->header.stamp, 2);
  std::int64_t stamp = 0;
  while (const auto m = settings.take()) stamp = m->header.stamp;
  EXPECT_EQ(stamp, link::kEndOfLink);
}

TEST_F(ArmLinksTest, TellsItsMacrostepAndNoStepOfItsOwn) {
  for (const ClockKind clock : {ClockKind::step, ClockKind::wall}) {
    begin(clock);
    link::Queue<process_status_t> status(*others, process->route("ecp-arm1.status"), 1);
    all(1);
    ASSERT_EQ(links->begin(), Outcome::terminated);
    all(2);
    ASSERT_EQ(links->wait(), Outcome::terminated);
    process->report_done();
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    std::optional<process_status_t> last;
    while (const auto m = status.take()) last = m;
    ASSERT_TRUE(last);
    EXPECT_EQ(last->macrostep, 2);
    EXPECT_EQ(last->step, 0);
  }
}

TEST_F(ArmLinksTest, WhereTheSystemEndsBeforeItHasBegunNothingIsSent) {
  begin(ClockKind::step);
  all(1);
  say(Phase::finished);
  while (own->wait(std::chrono::milliseconds(0))) {
  }
  EXPECT_EQ(links->begin(), Outcome::aborted);
  EXPECT_EQ(sent().header.stamp, 0);
  EXPECT_FALSE(reports->take());
}

TEST_F(ArmLinksTest, AStopEndsItInTheAgreedMacrostep) {
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  say(Phase::stopping, 3);
  all(2);
  ASSERT_EQ(links->wait(), Outcome::terminated);
  all(3);
  EXPECT_EQ(links->wait(), Outcome::aborted);
  EXPECT_EQ(links->i(), 3);
}

TEST_F(ArmLinksTest, AReplyWithANumberThatIsNotFiniteIsMalformed) {
  for (int number = 0; number < 4; ++number) {
    begin(ClockKind::step);
    EffectorReply r = told(1);
    const double bad = std::numeric_limits<double>::quiet_NaN();
    (number == 0 ? r.gripper : number == 1 ? r.T_0E[5] : number == 2 ? r.F_a[Axis::az] : r.motors[0]) = bad;
    reply(1, r);
    order(1);
    read(1);
    FaultCode code{};
    try {
      std::ignore = links->begin();
    } catch (const FaultError& e) {
      code = e.fault().code;
    }
    EXPECT_EQ(code, FaultCode::malformed_message) << number;
  }
}

struct Solo : ArmAgent<None> {};

EffectorCommand moves(const Solo::X&) { return move_arm({.x = u(0.1), .z = c(4, 20, 0.005)}, {}); }
bool never(const Solo::X&) { return false; }

/// @return the reply of macrostep i: the command that was sent in i - kCommandToReply has been executed
EffectorReply executed(std::int64_t i) {
  EffectorReply r;
  r.gripper = static_cast<double>(i);
  if (i <= latency::kCommandToReply) return r;
  r.verdict = Verdict::executed;
  r.number = i - latency::kCommandToReply;
  return r;
}

TEST_F(ArmLinksTest, APauseSlowsTheAgentsTimeDownToZeroWhileItsReportsGoOn) {
  constexpr std::int64_t kPause = 5, kResume = 40, kEnd = 70;
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  SoloPort<Solo> port(*links);
  const Motion<Solo> motion = row<Solo>(5, "moves", moves, never);
  Solo::X x;
  port.read(x);
  for (std::int64_t i = 2; i < kEnd; ++i) {
    reply(i, executed(i));
    read(i);
    const SoloOrder o = i >= kPause && i < kResume ? SoloOrder::pause : SoloOrder::work;
    orders->publish(to_message(Order{.m = static_cast<int>(o)}), i);
  }
  std::vector<std::int64_t> asked;  // macrosteps in which the row was
  while (links->i() < kEnd - 2) {
    port.dispatch(motion, {.c = {}, .e = motion.f_ce(x), .V = {}, .T = motion.f_cT(x)});
    const std::int64_t before = x.i;
    ASSERT_EQ(port.wait(), Outcome::terminated);
    port.read(x);
    EXPECT_EQ(x.i, before + 1) << "task time goes on by one macrostep";
    EXPECT_EQ(x.e.gripper, static_cast<double>(links->i()));
    asked.push_back(links->i());
  }
  for (const std::int64_t i : asked) EXPECT_TRUE(i < kPause + 10 || i >= kResume) << i;

  std::int64_t stamp = 1;
  double way = 0;
  (void)sent();
  for (effector_command_t c = sent(); c.header.stamp != 0; c = sent()) {
    EXPECT_EQ(c.header.stamp, ++stamp) << "one in every macrostep";
    way += c.arm.axis[0].velocity / 0.1;
    EXPECT_EQ(c.arm.axis[2].force, 4) << "forces stay";
    if (stamp > kPause + 10 && stamp <= kResume) {
      EXPECT_EQ(c.arm.axis[0].velocity, 0) << stamp;
    }
    if (stamp == kPause + 5) {
      EXPECT_NEAR(c.arm.axis[0].velocity, 0.05, 1e-12);
    }
  }
  EXPECT_NEAR(way, static_cast<double>(x.i - 1), 1) << "as far as task time has come";
  std::int64_t reported = 1;
  while (const auto r = reports->take()) {
    if (r->header.stamp < 2) continue;
    EXPECT_EQ(r->header.stamp, ++reported);
    EXPECT_EQ(r->m, 5) << "also in the pause";
    EXPECT_EQ(r->gripper, static_cast<double>(reported - 1)) << "what the agent sees now";
  }
}

TEST_F(ArmLinksTest, TheEndOfTheTaskDoesNotWaitForTaskTime) {
  begin(ClockKind::step);
  all(1);
  ASSERT_EQ(links->begin(), Outcome::terminated);
  SoloPort<Solo> port(*links);
  const Motion<Solo> motion = row<Solo>(5, "moves", moves, never);
  Solo::X x;
  port.read(x);
  for (std::int64_t i = 2; i <= 30; ++i) {
    reply(i, executed(i));
    read(i);
    orders->publish(to_message(Order{.m = static_cast<int>(SoloOrder::pause), .finished = i == 30}), i);
  }
  while (links->i() < 30) {
    port.dispatch(motion, {.c = {}, .e = motion.f_ce(x), .V = {}, .T = motion.f_cT(x)});
    if (port.wait() != Outcome::terminated) break;
    port.read(x);
  }
  EXPECT_EQ(links->i(), 30);
  EXPECT_TRUE(x.T.finished);
}

}  // namespace
}  // namespace mrroc::ecp
