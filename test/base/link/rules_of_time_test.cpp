// The rules of time (docs/architecture.md, R1-R5) with dummy agents.
#include <gtest/gtest.h>

#include <atomic>

#include "base/link/lcm_bus.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/memory_bus.hpp"
#include "base/link/process.hpp"
#include "base/link/session.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/ring.hpp"

namespace mrroc::link {
namespace {

using test::Behaviour;
using test::context_of;
using test::hashes_of;
using test::Ring;
using Hashes = std::map<std::string, std::int64_t>;

std::map<std::string, Behaviour> everybody(std::int64_t macrosteps) {
  return {{"a", {macrosteps}}, {"b", {macrosteps}}, {"c", {macrosteps}}};
}

Hashes run_to_the_end(const Ring::Open& open, std::int64_t macrosteps, std::int64_t session_id = 1) {
  Ring ring(open, everybody(macrosteps), session_id);
  EXPECT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
  ring.boss.say(Phase::running);
  EXPECT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::done); }));
  ring.finish();
  Hashes all;
  for (const auto& [name, status] : ring.boss.status) all.merge(hashes_of(status));
  EXPECT_EQ(all.size(), 3U);
  return all;
}

Hashes run_in_memory(std::int64_t macrosteps, std::int64_t session_id = 1) {
  MemoryHub hub;
  return run_to_the_end([&hub](const std::string&) { return hub.open(); }, macrosteps, session_id);
}

/// Keeps a processor busy, so that threads are interrupted anywhere.
class Load {
 public:
  Load()
      : thread_([this] {
          while (!end_) ++spins_;
        }) {}
  ~Load() { end_ = true; }
  Load(const Load&) = delete;
  Load& operator=(const Load&) = delete;

 private:
  std::atomic<bool> end_{false};
  std::atomic<std::int64_t> spins_{0};
  std::jthread thread_;
};

TEST(RulesOfTime, R1_RunsAreBitIdenticalWhateverTheSchedulerDoes) {
  const Hashes first = run_in_memory(30);
  const Load load;
  for (int run = 0; run < 100; ++run) ASSERT_EQ(run_in_memory(30), first) << "run " << run;
}

TEST(RulesOfTime, R3_HashesDoNotDependOnTheSession) {
  EXPECT_EQ(run_in_memory(30, 1), run_in_memory(30, 987654321));
  EXPECT_NE(run_in_memory(30), run_in_memory(31));
}

TEST(RulesOfTime, R1_RunsOverTheNetworkEqualThoseInMemory) {
  const LcmAddress address = address_for("rules-of-time-" + std::to_string(random_id() % 100000));
  const Key key = Key::random();
  if (!multicast_works(address)) GTEST_SKIP() << "no multicast on this host";
  const Hashes first = run_in_memory(30);
  for (int run = 0; run < 3; ++run) {
    const Hashes hashes =
        run_to_the_end([&](const std::string&) { return open_lcm(address, key); }, 30, random_id());
    ASSERT_EQ(hashes, first);
  }
}

/// A lossy end that owns the bus beneath.
class OwnLossyBus final : public Bus {
 public:
  OwnLossyBus(std::unique_ptr<Bus> under, int period)
      : under_(std::move(under)), lossy_(*under_, [this, period] { return ++n_ % period == 0; }) {}
  void publish(const Route& route, std::span<const std::uint8_t> bytes) override {
    lossy_.publish(route, bytes);
  }
  void subscribe(const Route& route, Sink& sink) override { lossy_.subscribe(route, sink); }
  void subscribe_all(const std::string& prefix, Sink& sink) override { lossy_.subscribe_all(prefix, sink); }
  bool wait(std::chrono::milliseconds timeout) override { return lossy_.wait(timeout); }

 private:
  std::unique_ptr<Bus> under_;
  int n_{};
  LossyBus lossy_;
};

TEST(RulesOfTime, R5_RealLossIsRepairedAndNeverChangesARun) {
  MemoryHub hub;
  int period = 11;
  const Hashes hashes = run_to_the_end(
      [&](const std::string&) -> std::unique_ptr<Bus> {
        return std::make_unique<OwnLossyBus>(hub.open(), period);
      },
      30);
  EXPECT_EQ(hashes, run_in_memory(30));
}

TEST(RulesOfTime, R5_LossIsRepairedThoughOtherMessagesKeepComing) {
  MemoryHub hub;
  const auto bus_a = hub.open(), bus_b = hub.open(), bus_chatter = hub.open();
  int publications = 0;
  LossyBus lossy(*bus_a, [&] { return ++publications == 1; });
  Process a(lossy, context_of("a"));
  Process b(*bus_b, context_of("b"));
  const auto out = a.outbox<operator_order_t>("a.out");
  const auto in = b.inbox<operator_order_t>("a.out");
  const auto news_a = a.inbox<operator_order_t>("chatter"), news_b = b.inbox<operator_order_t>("chatter");
  out->publish({}, 1);  // lost
  std::atomic<bool> arrived{false};
  const std::jthread chatter([&] {
    Outbox<operator_order_t> talk(*bus_chatter, a.route("chatter"), 1);
    for (int k = 0; k < 300 && !arrived; ++k) {
      talk.publish({}, k);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  const std::jthread waits([&] {
    arrived = b.await([&] { return in->at(1) != nullptr; }, Process::Clock::now() + std::chrono::seconds(3));
  });
  a.await([&] { return arrived.load(); }, Process::Clock::now() + std::chrono::seconds(3));
  EXPECT_TRUE(arrived);
}

TEST(RulesOfTime, R2_NobodyBeginsBeforeAllAreThere) {
  MemoryHub hub;
  const auto open = [&hub](const std::string&) { return hub.open(); };
  Ring ring(open, everybody(10));
  ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
  int looks = 0;
  ring.boss.await([&] { return ++looks > 5; });
  EXPECT_TRUE(ring.boss.all(ProcessState::ready));  // still
  for (const auto& [name, status] : ring.boss.status) EXPECT_EQ(status.macrostep, 0) << name;
  ring.boss.say(Phase::running);
  EXPECT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::done); }));
}

TEST(RulesOfTime, R2_ASystemThatEndsWhileAssemblingEndsEverybody) {
  MemoryHub hub;
  Ring ring([&hub](const std::string&) { return hub.open(); }, everybody(10));
  ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
  ring.finish();
  for (const auto& [name, trace] : ring.traces) EXPECT_EQ(trace.ended_in, 0) << name;
}

TEST(RulesOfTime, StopActsInTheSameMacrostepEverywhere) {
  for (int run = 0; run < 10; ++run) {
    MemoryHub hub;
    Ring ring([&hub](const std::string&) { return hub.open(); }, everybody(1'000'000));
    ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
    ring.boss.say(Phase::running);
    if (run % 2) ring.boss.await([&] { return ring.boss.is("a", ProcessState::running); });
    ring.boss.say(Phase::stopping,
                  5000);  // far ahead of everybody, heard by some together with the beginning
    ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::done); }));
    ring.finish();
    for (const auto& [name, trace] : ring.traces) EXPECT_EQ(trace.ended_in, 5000) << name;
  }
}

TEST(RulesOfTime, StopAtOnceEndsWhoeverWaits) {
  MemoryHub hub;
  auto behaviours = everybody(1000);
  behaviours["a"].dies_in = 40;  // and nobody notices
  Ring ring([&hub](const std::string&) { return hub.open(); }, behaviours);
  ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
  ring.boss.say(Phase::running);
  // Whoever is still assembling when the system stops ends without a word.
  ASSERT_TRUE(ring.boss.await(
      [&] { return ring.boss.is("b", ProcessState::running) && ring.boss.is("c", ProcessState::running); }));
  ring.boss.say(Phase::stopping, 0);
  const auto both = [&] {
    return ring.boss.is("b", ProcessState::done) && ring.boss.is("c", ProcessState::done);
  };
  EXPECT_TRUE(ring.boss.await(both));
}

TEST(RulesOfTime, R4_ADeadPeerIsSilentFromItsLastMessageOnAndTheOthersGoOn) {
  std::vector<std::int64_t> values;
  for (int run = 0; run < 10; ++run) {
    MemoryHub hub;
    std::atomic<bool> died{false};
    auto behaviours = everybody(60);
    behaviours["a"].dies_in = 50;
    behaviours["a"].died = &died;
    Ring ring([&hub](const std::string&) { return hub.open(); }, behaviours);
    ASSERT_TRUE(ring.boss.await([&] { return ring.boss.all(ProcessState::ready); }));
    ring.boss.say(Phase::running);
    ASSERT_TRUE(ring.boss.await([&] { return died.load(); }));
    ring.boss.declare_dead(1);
    const auto both = [&] {
      return ring.boss.is("b", ProcessState::done) && ring.boss.is("c", ProcessState::done);
    };
    ASSERT_TRUE(ring.boss.await(both));
    ring.finish();
    EXPECT_EQ(ring.traces["a"].ended_in, 50);
    EXPECT_EQ(ring.traces["b"].ended_in, 61);
    EXPECT_EQ(ring.traces["c"].ended_in, 61);
    EXPECT_EQ(ring.traces["b"].silent_in, 51);
    EXPECT_EQ(ring.traces["c"].silent_in, 0);
    values.push_back(ring.traces["c"].value);
    EXPECT_EQ(values.back(), values.front());
  }
}

}  // namespace
}  // namespace mrroc::link
