// The whole chain MP - ECP - EDP - simulator with the real shells and links and an ideal arm: delay accounting
// of MG (11)-(15), the end of a run, and injected faults.
#include <gtest/gtest.h>

#include "base/latency.hpp"
#include "test/mp/chain.hpp"

namespace mrroc::mp {
namespace {

using test::Chain;
using test::kSteps;

TEST(DelayAccounting, OrderCommandExecutionAndStateAreOneTwoTwoAndFourMacrostepsApart) {
  constexpr std::int64_t kOrdered = 20;  // macrostep in which MP decides to move
  std::int64_t ordered_by_state = 0;     // first macrostep in which MP could answer to the motion
  Chain chain;
  std::optional<double> x_0;
  const Outcome o = chain.run(
      40, [](std::int64_t i) { return i == kOrdered ? 0.05 : 0.0; },
      [&](std::int64_t i, const Report& r) {
        if (i < kOrdered) x_0 = r.T_0E[0];
        if (ordered_by_state == 0 && i >= kOrdered && std::abs(r.T_0E[0] - *x_0) > 1e-6) ordered_by_state = i;
      });
  ASSERT_EQ(o, Outcome::terminated);
  std::int64_t executed_in = 0;  // stamp of the command = macrostep of its execution
  std::int64_t seen = 0;
  while (const auto c = chain.commands.take())
    if (c->header.number > seen && c->arm.axis[0].velocity != 0) {
      seen = c->header.number;
      EXPECT_EQ(executed_in, 0) << "the order was copied twice";
      executed_in = c->header.stamp;
    }
  const std::int64_t commanded_in = executed_in - 1;
  EXPECT_EQ(commanded_in - kOrdered, latency::kOrderToCommand);  // MG (11)
  EXPECT_EQ(executed_in - kOrdered, latency::kOrderToMotion);    // (12)
  EXPECT_EQ(chain.first_motion / kSteps, executed_in) << "and that is what the arm does";
  EXPECT_EQ(ordered_by_state - executed_in, latency::kMotionToReport);  // (14)
  EXPECT_EQ(ordered_by_state - kOrdered, latency::kLoop);               // (15)
}

TEST(Chain, RunsAreBitIdentical) {
  std::optional<std::uint64_t> first;
  for (int k = 0; k < 5; ++k) {
    Chain chain;
    ASSERT_EQ(
        chain.run(
            30, [](std::int64_t i) { return 0.001 * static_cast<double>(i % 7); }, [](auto, const auto&) {}),
        Outcome::terminated);
    EXPECT_FALSE(chain.supervisor.fault());
    EXPECT_NE(chain.supervisor.log_hash(), 0U);
    if (!first) first = chain.supervisor.log_hash();
    EXPECT_EQ(chain.supervisor.log_hash(), *first);
  }
}

TEST(Chain, InjectedFaultsNeverChangeTheOrderOfCommandsNorHinderTheEnd) {
  std::int64_t repeated = 0, lost_before = 0;
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    Chain chain({.loss = 0.01, .duplication = 0.02, .delay = 0.01, .max_delay = 3, .seed = seed});
    const Outcome o = chain.run(
        300, [](std::int64_t i) { return i % 2 ? 0.002 : -0.002; }, [](auto, const auto&) {});
    ASSERT_EQ(o, Outcome::terminated) << "seed " << seed;
    EXPECT_FALSE(chain.supervisor.fault());
    std::int64_t last = 0, executed = 0, not_executed = 0;
    std::int64_t seen = 0;
    while (const auto r = chain.replies.take()) {
      if (r->header.number <= seen) continue;  // sent again because somebody waited
      seen = r->header.number;
      if (static_cast<Verdict>(r->verdict) != Verdict::executed) {
        ++not_executed;
        continue;
      }
      EXPECT_TRUE(r->number == last || r->number == last + 1) << r->number << " after " << last;
      last = r->number;
      ++executed;
    }
    EXPECT_GT(executed, 250);
    EXPECT_GT(not_executed, 0);
    repeated += chain.protocol().repeated();
    lost_before += chain.protocol().lost();
  }
  EXPECT_GT(repeated, 5) << "duplicates must reach the protocol";
  EXPECT_GT(lost_before, 5);
}

TEST(Chain, ALinkThatLosesEverythingEndsInASystemError) {
  Chain chain({.loss = 1});
  EXPECT_NE(chain.run(
                100, [](auto) { return 0; }, [](auto, const auto&) {}),
            Outcome::terminated);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->code, FaultCode::command_repeated_refused);
}

TEST(Chain, ASessionEndsWithItsOwner) {
  Chain chain;
  chain.rests = "ecp-arm1";
  chain.fails = true;
  EXPECT_NE(chain.run(
                100, [](auto) { return 0; },
                [&](std::int64_t i, const auto&) {
                  if (i == 20) chain.interrupt();
                }),
            Outcome::terminated);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->process.view(), "ecp-arm1");
  EXPECT_TRUE(chain.mp.dead("ecp-arm1"));
  EXPECT_FALSE(chain.protocol().owner());
}

TEST(Chain, AnArmThatCannotDoWhatItIsToldEndsTheTaskWithItsReason) {
  Chain chain;
  EXPECT_EQ(chain.run(
                100, [](std::int64_t i) { return i > 20 ? std::nan("") : 0.0; }, [](auto, const auto&) {}),
            Outcome::faulted);
  ASSERT_TRUE(chain.supervisor.fault());
  EXPECT_EQ(chain.supervisor.fault()->code, FaultCode::not_finite);
}

}  // namespace
}  // namespace mrroc::mp
