// The links of a platform's agent and its preparation, with the test as driver and coordinator.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "base/agent_images.hpp"
#include "base/link/memory_bus.hpp"
#include "base/msg/convert_platform.hpp"
#include "ecp/effector_links.hpp"
#include "ecp/preparation.hpp"
#include "ecp/shell.hpp"
#include "test/base/link/one_by_one_bus.hpp"

namespace mrroc::ecp {
namespace {

class PlatformLinksTest : public testing::Test {
 protected:
  PlatformLinksTest() {
    link::NodeContext m;
    m.session = "links";
    m.name = "ecp-rex";
    m.roster = {"mp", m.name};
    m.timeout = std::chrono::seconds(20);
    process.emplace(*own, m);
    links.emplace(*process, EffectorLinkNames{.robot = "rex", .sensor = ""});
    replies.emplace(*others, process->route("rex.reply"), 1);
    orders.emplace(*others, process->route("rex.order"), 1);
    supervisor.emplace(*others, process->route("supervisor"), 1);
    commands.emplace(*others, process->route("rex.command"), 1);
    reports.emplace(*others, process->route("rex.report"), 1);
    supervisor_t running{};
    running.phase = static_cast<int>(link::Phase::running);
    supervisor->publish(running, 0);
  }
  void reply(std::int64_t i, const PlatformReply& r) {
    replies->publish(to_message(r), i);
    orders->publish(to_message(Order{.m = static_cast<int>(i)}), i);
  }
  /// Gives these replies, one per macrostep, and receives the first.
  void begin(const std::vector<PlatformReply>& answers) {
    for (std::size_t k = 0; k < answers.size(); ++k) reply(static_cast<std::int64_t>(k) + 1, answers[k]);
    ASSERT_EQ(links->begin(), Outcome::terminated);
  }
  template <class M>
  std::vector<M> all(link::Queue<M>& queue) {
    while (others->wait(std::chrono::milliseconds(0))) {
    }
    std::vector<M> messages;
    while (const auto m = queue.take()) messages.push_back(*m);
    return messages;
  }
  static PlatformReply told(DriverState state) {
    PlatformReply r;
    r.state = state;
    return r;
  }
  static PlatformReply answered(DriverState state, Verdict verdict, FaultCode code = FaultCode::none) {
    PlatformReply r = told(state);
    r.number = 1;
    r.expected = 2;
    r.verdict = verdict;
    r.fault.code = code;
    return r;
  }

  link::MemoryHub hub;
  std::unique_ptr<link::Bus> own = std::make_unique<link::test::OneByOneBus>(hub.open()), others = hub.open();
  std::optional<link::Process> process;
  std::optional<PlatformLinks> links;
  std::optional<link::Outbox<platform_reply_t>> replies;
  std::optional<link::Outbox<agent_order_t>> orders;
  std::optional<link::Outbox<supervisor_t>> supervisor;
  std::optional<link::Queue<platform_command_t>> commands;
  std::optional<link::Queue<agent_report_t>> reports;
};

TEST_F(PlatformLinksTest, GiveTheReplyAndTheOrderOfTheMacrostepAndSendCommandAndReportForTheNext) {
  PlatformReply first;
  first.notified = 4;
  first.estimate.p = {1, 2, 3};
  begin({first});
  EXPECT_EQ(links->i(), 1);
  EXPECT_EQ(links->reply().notified, 4);
  EXPECT_EQ(links->reply().macrostep, 1);
  EXPECT_EQ(links->reply().estimate.p.y, 2);
  EXPECT_EQ(links->order().m, 1);
  PlatformCommand c{.instruction = Instruction::set, .pace = 0.25};
  c.fragment.number = 3;
  links->send(c, {.m = 7});
  const auto sent = all(*commands);
  ASSERT_EQ(sent.size(), 2U);
  EXPECT_EQ(sent[0].instruction, static_cast<int>(Instruction::keep));
  EXPECT_EQ(sent[1].header.stamp, 2);
  EXPECT_EQ(sent[1].fragment.number, 3);
  EXPECT_EQ(sent[1].pace, 0.25);
  EXPECT_EQ(all(*reports).back().m, 7);
}

TEST_F(PlatformLinksTest, AReplyThatIsNotProperIsMalformed) {
  PlatformReply r;
  r.estimate.v.w = std::numeric_limits<double>::quiet_NaN();
  reply(1, r);
  try {
    std::ignore = links->begin();
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::malformed_message);
    EXPECT_NE(e.fault().text.view().find("rex.reply"), std::string_view::npos);
  }
}

TEST_F(PlatformLinksTest, SynchroIsGivenThePositionsThatItWaitsForUntilThePlatformIsReady) {
  std::vector<PlatformReply> answers(2, told(DriverState::not_synchronised));
  answers.push_back(answered(DriverState::homing, Verdict::executed));
  for (int k = 0; k < 5; ++k) answers.push_back(told(DriverState::homing));
  PlatformReply ready = told(DriverState::ready);
  ready.position_known = true;
  ready.estimate.p = {1, 2, 0.5};
  answers.push_back(ready);
  begin(answers);
  std::int64_t asked = 0;
  const PlatformPreparation prepare{[&](PlatformCommand& c) { c.map.step = ++asked; }};
  EXPECT_EQ(prepare_effector(*links, prepare), Outcome::terminated);
  EXPECT_EQ(links->i(), static_cast<std::int64_t>(answers.size()));
  const auto sent = all(*commands);
  ASSERT_EQ(sent.size(), answers.size());
  for (std::size_t k = 1; k < sent.size(); ++k) {
    EXPECT_EQ(sent[k].map.step, static_cast<std::int64_t>(k)) << "in every macrostep";
    EXPECT_EQ(sent[k].instruction, static_cast<int>(k == 1 ? Instruction::synchro : Instruction::keep));
  }
  for (const agent_report_t& report : all(*reports)) EXPECT_EQ(report.ready, 0);
}

TEST_F(PlatformLinksTest, SynchroThatDoesNotFindThePlatformIsTheReason) {
  PlatformReply lost = told(DriverState::not_synchronised);
  lost.fault.code = FaultCode::internal_error;
  begin({told(DriverState::not_synchronised), told(DriverState::not_synchronised),
         answered(DriverState::homing, Verdict::executed), told(DriverState::homing), lost});
  EXPECT_EQ(prepare_effector(*links, {}), Outcome::faulted);
  EXPECT_EQ(fault_of(*links).code, FaultCode::internal_error);
}

TEST_F(PlatformLinksTest, WhatIsReportedBeforeItIsReadyIsWhatTheDriverTells) {
  PlatformReply r = answered(DriverState::holding, Verdict::refused, FaultCode::not_owner);
  r.position_known = true;
  r.estimate.p = {1, 2, 0.5};
  begin({r, r, r});
  EXPECT_EQ(prepare_effector(*links, {}), Outcome::faulted);
  EXPECT_EQ(fault_of(*links).code, FaultCode::not_owner);
  const agent_report_t report = all(*reports).back();
  EXPECT_EQ(report.ready, 0);
  EXPECT_EQ(report.driver_state, static_cast<int>(DriverState::holding));
  EXPECT_EQ(report.verdict, static_cast<int>(Verdict::refused));
  EXPECT_EQ(report.fault.code, static_cast<int>(FaultCode::not_owner));
  EXPECT_EQ(report.position_known, 1);
  const std::array<double, 6> place{1, 2, 0, 0, 0, 0.5};
  EXPECT_TRUE(std::ranges::equal(report.T_0E, place));
}

struct Platform {
  struct X {
    None c;
    PlatformReply e;
    OdometryReading V;
    Order T;
    std::int64_t i{};
    std::int64_t i_0{};
  };
  struct Y {
    None c;
    PlatformCommand e;
    None V;
    Report T;
  };
};

None nothing(const Platform::X&) { return {}; }
PlatformCommand slow_down(const Platform::X& x) { return {.pace = 1.0 / static_cast<double>(x.i)}; }
Report tell(const Platform::X&) { return {.m = 4}; }
bool third(const Platform::X& x) { return x.i >= 3; }

TEST_F(PlatformLinksTest, ThePortCarriesTheImagesOfAPlatformsBehaviour) {
  std::vector<PlatformReply> answers(3, told(DriverState::ready));
  answers[2].remaining = 12;
  begin(answers);
  EffectorPort<Platform, PlatformEffector> port(*links);
  const Motion<Platform> motion{4, "slow down", nothing, nothing, slow_down, nothing, tell, third};
  Platform::X x{};
  port.read(x);
  EXPECT_EQ(move(motion, x, port), Outcome::terminated);
  EXPECT_EQ(x.i, 3);
  EXPECT_EQ(x.e.remaining, 12);
  EXPECT_EQ(x.T.m, 3);
  const auto sent = all(*commands);
  ASSERT_EQ(sent.size(), 3U);
  EXPECT_EQ(sent[1].pace, 1);
  EXPECT_EQ(sent[2].pace, 0.5);
}

}  // namespace
}  // namespace mrroc::ecp
