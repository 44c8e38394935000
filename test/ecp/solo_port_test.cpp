// The port of an agent that works on its own, while the coordinator pauses the task.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

#include "ecp/solo.hpp"
#include "test/ecp/effector_links_fixture.hpp"

namespace mrroc::ecp {
namespace {

struct Agent : ArmAgent<None> {};

EffectorCommand push(const Agent::X&) { return move_arm({.x = u(0.1)}, {}); }
bool never(const Agent::X&) { return false; }

/// @return the answer in macrostep i: the command before last has been executed
EffectorReply executed(std::int64_t i) {
  EffectorReply r;
  r.gripper = static_cast<double>(i);
  if (i <= latency::kCommandToReply) return r;
  r.verdict = Verdict::executed;
  r.number = i - latency::kCommandToReply;
  return r;
}

constexpr std::int64_t kPause = 5, kStands = kPause + TaskClock::kRamp + 1, kResume = 40;

class PausedPort : public test::ArmLinksTest {
 protected:
  /// Gives all that comes until a macrostep: a pause, and what else is to be answered where.
  void begin_until(std::int64_t end, const std::map<std::int64_t, EffectorReply>& answers = {}) {
    begin(ClockKind::step);
    all(1);
    ASSERT_EQ(links->begin(), Outcome::terminated);
    for (std::int64_t i = 2; i <= end; ++i) {
      const auto other = answers.find(i);
      reply(i, other == answers.end() ? executed(i) : other->second);
      read(i);
      const bool paused = i >= kPause && i < kResume;
      orders->publish(to_message(Order{.m = static_cast<int>(paused ? SoloOrder::pause : SoloOrder::work)}),
                      i);
    }
  }
  /// One macrostep of task time. @return the macrostep in which it has ended
  std::int64_t step(SoloPort<Agent>& port, Agent::X& x) {
    port.dispatch(motion, {.c = {}, .e = motion.f_ce(x), .V = {}, .T = motion.f_cT(x)});
    EXPECT_EQ(port.wait(), Outcome::terminated);
    port.read(x);
    return links->i();
  }

  Motion<Agent> motion = row<Agent>(5, "push", push, never);
};

TEST_F(PausedPort, WhatIsUrgentIsNotWaitedForThoughTaskTimeStands) {
  constexpr std::int64_t kUrgent = 30;
  ASSERT_LT(kStands, kUrgent);
  begin_until(50);
  SoloPort<Agent> port(*links);
  port.also({.urgent = [](const Agent::X& x) { return x.e.gripper == static_cast<double>(kUrgent); }});
  Agent::X x;
  port.read(x);
  std::vector<std::int64_t> asked;
  while (links->i() < 50 - 2) {
    const std::int64_t before = x.i;
    asked.push_back(step(port, x));
    EXPECT_EQ(x.i, before + 1) << "the agent's macrosteps have no gap";
  }
  int in_standstill = 0;
  for (const std::int64_t i : asked)
    if (i > kStands && i < kResume) {
      EXPECT_EQ(i, kUrgent) << "as soon as it is known, and once";
      ++in_standstill;
    }
  EXPECT_EQ(in_standstill, 1);
}

TEST_F(PausedPort, AMishapThatEndsTheBehaviourDoesNotWaitForTaskTimeAndAnyOtherDoes) {
  constexpr std::int64_t kMishap = 30;
  EffectorReply refused = executed(kMishap);
  refused.verdict = Verdict::refused;
  refused.fault.code = FaultCode::joint_limit;
  refused.expected = refused.number + 1;
  for (const Response response : {Response::next_behaviour, Response::repeat, Response::go_on}) {
    motion.policy = respond(response);
    begin_until(50, {{kMishap, refused}});
    SoloPort<Agent> port(*links);
    Agent::X x;
    port.read(x);
    bool asked = false;
    while (links->i() < kResume - 5 && !asked)
      if (const std::int64_t i = step(port, x); i > kStands) asked = i == kMishap;
    EXPECT_EQ(asked, response != Response::go_on) << static_cast<int>(response);
  }
}

TEST_F(PausedPort, TellsThePartsThatItSentForThisMacrostepAndTheOneBeforeAndNothingOfWholeCommands) {
  begin_until(70);
  SoloPort<Agent> port(*links);
  Agent::X x;
  port.read(x);
  std::map<std::int64_t, double> speed{{1, 0.1}};  // that was sent for a macrostep
  int parts = 0, whole = 0;
  while (links->i() < 65) {
    const std::int64_t now = step(port, x);
    for (effector_command_t c = sent(); c.header.stamp != 0; c = sent())
      if (c.header.stamp > 1) speed[c.header.stamp] = c.arm.axis[0].velocity;
    const auto told = port.sent_parts();
    const bool both_whole = speed.at(now) == 0.1 && speed.at(now - 1) == 0.1;
    if (now < kPause || now > kResume + TaskClock::kRamp + 2) {
      EXPECT_TRUE(both_whole && !told) << now;
      ++whole;
    }
    if (!told) {
      EXPECT_TRUE(both_whole) << now;
      continue;
    }
    ++parts;
    EXPECT_EQ((*told)[0].arm.frame.x.velocity, speed.at(now)) << now;
    EXPECT_EQ((*told)[1].arm.frame.x.velocity, speed.at(now - 1)) << now;
    EXPECT_TRUE(speed.at(now) < 0.1 || speed.at(now - 1) < 0.1) << now;
  }
  EXPECT_GT(parts, 10);
  EXPECT_GT(whole, 5);
}

TEST_F(PausedPort, WhatIsReadBesidesIsReadWithEveryImage) {
  begin_until(50);
  SoloPort<Agent> port(*links);
  std::vector<std::int64_t> seen;
  port.also({.read = [&](Agent::X& x) {
    EXPECT_EQ(x.e.gripper, static_cast<double>(links->i())) << "the rest of the image is there";
    seen.push_back(links->i());
    x.e.blocked = true;
  }});
  Agent::X x;
  port.read(x);
  EXPECT_TRUE(x.e.blocked) << "what it writes stays";
  while (links->i() < 48) step(port, x);
  for (std::int64_t i = 1; i <= 48; ++i)
    EXPECT_TRUE(std::ranges::find(seen, i) != seen.end()) << i << ", also where task time stands";
}

}  // namespace
}  // namespace mrroc::ecp
