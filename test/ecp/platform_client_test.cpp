// Commands of a platform: what is numbered is repeated when it is lost, what is not goes out as it is now.
#include "ecp/effector_client.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <type_traits>
#include <vector>

#include "base/effector.hpp"

namespace mrroc::ecp {
namespace {

using Client = BasicEffectorClient<PlatformEffector>;
constexpr std::int64_t kSession = 5;

static_assert(std::is_same_v<EffectorClient, BasicEffectorClient<ArmEffector>>);

PlatformCommand wanted(std::int64_t macrostep, Instruction instruction) {
  PlatformCommand c;
  c.instruction = instruction;
  c.pace = 1.0 / static_cast<double>(macrostep);
  c.odometry.step = 40 * macrostep;
  c.map.step = 10 * macrostep;
  return c;
}

/// @return x_ce of a macrostep whose command has not come
PlatformReply unseen(std::int64_t macrostep) {
  PlatformReply r;
  r.macrostep = macrostep;
  r.session = kSession;
  r.expected = 1;
  return r;
}

TEST(PlatformClient, ALostFragmentIsSentAgainWithWhatIsNewest) {
  Client client(kSession);
  PlatformCommand set = wanted(1, Instruction::set);
  set.fragment.number = 9;
  set.fragment.steps = 70;
  EXPECT_EQ(client.next(set, 1).number, 1);
  client.see(unseen(2));
  const PlatformCommand again = client.next(wanted(2, Instruction::keep), 2);
  EXPECT_EQ(again.instruction, Instruction::set);
  EXPECT_EQ(again.number, 1);
  EXPECT_EQ(again.macrostep, 2);
  EXPECT_EQ(again.fragment.number, 9);
  EXPECT_EQ(again.fragment.steps, 70);
  EXPECT_EQ(again.pace, 0.5);
  EXPECT_EQ(again.odometry.step, 80);
  EXPECT_EQ(again.map.step, 20);
}

TEST(PlatformClient, EveryMessageHasWhatIsNewestWhateverIsLost) {
  std::mt19937 random(3);
  for (int trial = 0; trial < 50; ++trial) {
    Client client(kSession);
    std::vector<std::int64_t> executed;
    PlatformReply reply = unseen(1);
    for (std::int64_t i = 1; i <= 60; ++i) {
      client.see(reply);
      ASSERT_FALSE(client.fault());
      PlatformCommand want = wanted(i, i <= 40 && random() % 2 != 0 ? Instruction::set : Instruction::keep);
      if (i == 30) want.instruction = Instruction::query;
      const PlatformCommand sent = client.next(want, i);
      EXPECT_EQ(sent.session, kSession);
      EXPECT_EQ(sent.pace, want.pace);
      EXPECT_EQ(sent.odometry.step, want.odometry.step);
      EXPECT_EQ(sent.map.step, want.map.step);
      const bool lost = i % 3 == trial % 3;  // never three times in a row
      const auto expected = static_cast<std::int64_t>(executed.size()) + 1;
      reply = unseen(i + 1);
      reply.expected = expected;
      if (lost || sent.instruction == Instruction::keep) continue;
      reply.number = sent.number;
      reply.verdict = sent.number == expected ? Verdict::executed : Verdict::refused;
      if (sent.number == expected)
        executed.push_back(sent.number);
      else
        reply.fault.code = FaultCode::lost_command;
      reply.expected = static_cast<std::int64_t>(executed.size()) + 1;
    }
    for (std::size_t k = 0; k < executed.size(); ++k)
      EXPECT_EQ(executed[k], static_cast<std::int64_t>(k) + 1);
    EXPECT_EQ(client.backlog(), 0U);
  }
}

TEST(PlatformClient, AReleaseGoesOutAtOnce) {
  Client client(kSession);
  std::ignore = client.next(wanted(1, Instruction::set), 1);
  client.see(unseen(2));
  EXPECT_EQ(client.next(wanted(2, Instruction::release), 2).instruction, Instruction::release);
}

}  // namespace
}  // namespace mrroc::ecp
