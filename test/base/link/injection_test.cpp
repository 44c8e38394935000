// Injected loss, duplication and delay: a pure function of seed and stamp, with the rates that are asked for.
#include "base/link/injection.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "base/link/channel.hpp"
#include "base/link/lossy_bus.hpp"
#include "mrroc/operator_order_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

constexpr int kSamples = 200000;

struct Rates {
  double lost{}, doubled{}, delayed{};
  std::array<int, Injection::kMaxDelay + 1> delays{};
};

Rates measure(const Injection& injection) {
  Rates r;
  for (std::int64_t stamp = 0; stamp < kSamples; ++stamp) {
    const auto fate = injection.fate(stamp);
    if (fate.copies == 0) r.lost += 1.0 / kSamples;
    if (fate.copies == 2) r.doubled += 1.0 / kSamples;
    if (fate.delay > 0) r.delayed += 1.0 / kSamples;
    ++r.delays.at(static_cast<std::size_t>(fate.delay));
  }
  return r;
}

TEST(Injection, NothingIsInjectedUnlessAsked) {
  const Rates r = measure({});
  EXPECT_EQ(r.lost + r.doubled + r.delayed, 0);
}

TEST(Injection, FateDependsOnSeedAndStampAlone) {
  Injection a{.loss = 0.2, .duplication = 0.2, .delay = 0.2, .seed = 5};
  const Injection b = a;
  int different = 0;
  for (std::int64_t stamp = 10000; stamp-- > 0;) {
    const auto fate = a.fate(stamp);
    EXPECT_EQ(fate.copies, b.fate(stamp).copies);
    EXPECT_EQ(fate.delay, b.fate(stamp).delay);
    a.seed = 6;
    different += a.fate(stamp).copies != fate.copies || a.fate(stamp).delay != fate.delay;
    a.seed = 5;
  }
  EXPECT_GT(different, 4000);
}

TEST(Injection, RatesAreTheOnesAskedFor) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Rates r = measure({.loss = 0.05, .duplication = 0.1, .delay = 0.2, .max_delay = 3, .seed = seed});
    // four standard deviations of a frequency
    EXPECT_NEAR(r.lost, 0.05, 4 * 0.0005);
    EXPECT_NEAR(r.doubled, 0.1, 4 * 0.0007);
    EXPECT_NEAR(r.delayed, 0.2, 4 * 0.0009);
    for (std::size_t d = 1; d <= 3; ++d) EXPECT_NEAR(r.delays[d] / (0.2 * kSamples), 1.0 / 3, 0.02);
    EXPECT_EQ(r.delays[4], 0);
  }
}

TEST(Injection, FatesOfNeighboursAreIndependent) {
  const Injection injection{.loss = 0.3, .seed = 9};
  int pairs = 0;
  for (std::int64_t stamp = 0; stamp < kSamples; ++stamp)
    pairs += injection.fate(stamp).copies == 0 && injection.fate(stamp + 1).copies == 0;
  EXPECT_NEAR(pairs / static_cast<double>(kSamples), 0.09, 0.004);
}

TEST(Injection, ProbabilityOneIsCertain) {
  EXPECT_NEAR(measure({.loss = 1}).lost, 1, 1e-9);
  EXPECT_NEAR(measure({.duplication = 1}).doubled, 1, 1e-9);
  EXPECT_NEAR(measure({.delay = 1, .max_delay = Injection::kMaxDelay}).delayed, 1, 1e-9);
}

/// What a receiver sees, over a run.
std::vector<std::int64_t> seen(const Injection& injection, std::int64_t run) {
  test::DirectBus bus;
  const Route route{Group::agents, "s.a"};
  Inbox<operator_order_t> in(bus, route, 1);
  Outbox<operator_order_t> out(bus, route, 1);
  std::vector<std::int64_t> ids;
  for (std::int64_t stamp = 1; stamp <= run; ++stamp) {
    operator_order_t m{};
    m.id = stamp;
    out.publish(m, stamp);
    in.due(stamp, injection, [&](const operator_order_t& due) { ids.push_back(due.id); });
  }
  return ids;
}

TEST(Injection, ReceiverSeesEveryMessageOnceWhenNothingIsInjected) {
  const auto ids = seen({}, 100);
  ASSERT_EQ(ids.size(), 100U);
  for (std::size_t k = 0; k < 100; ++k) EXPECT_EQ(ids[k], static_cast<std::int64_t>(k) + 1);
}

TEST(Injection, ReceiverSeesEveryMessageAsOftenAndAsLateAsItsFateSays) {
  const Injection injection{.loss = 0.2, .duplication = 0.2, .delay = 0.4, .max_delay = 4, .seed = 3};
  constexpr std::int64_t kRun = 5000;
  std::vector<std::int64_t> expected;
  for (std::int64_t now = 1; now <= kRun; ++now)
    for (std::int64_t sent = 1; sent <= now; ++sent) {
      if (now - sent > Injection::kMaxDelay) continue;
      const auto fate = injection.fate(sent);
      for (int copy = 0; copy < fate.copies && sent + fate.delay == now; ++copy) expected.push_back(sent);
    }
  EXPECT_EQ(seen(injection, kRun), expected);
}

TEST(Injection, RealLossUnderneathChangesNothing) {
  const Injection injection{.loss = 0.1, .duplication = 0.1, .delay = 0.2, .seed = 8};
  test::DirectBus bus;
  std::mt19937 random(4);
  LossyBus lossy(bus, [&] { return random() % 3 != 0; });
  const Route route{Group::agents, "s.a"};
  Inbox<operator_order_t> in(bus, route, 1);
  Outbox<operator_order_t> out(lossy, route, 1);
  std::vector<std::int64_t> ids;
  for (std::int64_t stamp = 1; stamp <= 1000; ++stamp) {
    operator_order_t m{};
    m.id = stamp;
    out.publish(m, stamp);
    while (!in.at(stamp)) out.repeat();
    in.due(stamp, injection, [&](const operator_order_t& due) { ids.push_back(due.id); });
  }
  EXPECT_EQ(ids, seen(injection, 1000));
}

}  // namespace
}  // namespace mrroc::link
