// A process of a system: messages from and to the supervisor, and the limits of its waits.
#include "base/link/process.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <optional>

#include "base/link/memory_bus.hpp"
#include "test/base/link/buses.hpp"
#include "test/base/link/ring.hpp"

namespace mrroc::link {
namespace {

using test::context_of;

TEST(Process, EndsWhenNothingIsHeardOfTheSupervisor) {
  MemoryHub hub;
  const auto bus = hub.open();
  NodeContext orphan = context_of("b");
  orphan.roster = {"a", "b"};
  orphan.timeout = std::chrono::hours(1);  // a run at a slow pace
  orphan.alone = std::chrono::milliseconds(50);
  Process b(*bus, orphan);
  try {
    b.assemble();
    FAIL() << "it waited for ever";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
  }
}

TEST(Process, EndsAlsoByTheWallClockWhenTheSupervisorStaysAway) {
  test::DirectBus bus;
  NodeContext orphan = context_of("b");
  orphan.roster = {"a", "b"};
  orphan.clock = ClockKind::wall;
  orphan.timeout = std::chrono::hours(1);
  orphan.alone = std::chrono::milliseconds(1500);
  Process b(bus, orphan);
  Outbox<supervisor_t> supervisor(bus, b.route("supervisor"), 1);
  supervisor_t running{};
  running.phase = static_cast<int>(Phase::running);
  supervisor.publish(running, 0);
  ASSERT_EQ(b.phase(), Phase::running);
  const auto begun = Process::Clock::now();
  try {
    b.await([&] { return Process::Clock::now() - begun > std::chrono::minutes(2); });
    FAIL() << "it waited for ever";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::peer_silent);
  }
  EXPECT_TRUE(b.over()) << "it came to rest before";
}

TEST(Process, KnowsWhatTheSupervisorSaidLast) {
  test::DirectBus bus;
  Process p(bus, context_of("b"));
  Outbox<supervisor_t> supervisor(bus, p.route("supervisor"), 1);
  Outbox<supervisor_t> stranger(bus, p.route("supervisor"), 2);
  EXPECT_EQ(p.phase(), Phase::assembling);
  EXPECT_FALSE(p.over());
  supervisor_t m{};
  m.phase = static_cast<int>(Phase::finished);
  m.dead = 15;
  stranger.publish(m, 0);
  EXPECT_EQ(p.phase(), Phase::assembling);
  m.phase = static_cast<int>(Phase::running);
  m.dead = 0b0110;
  supervisor.publish(m, 0);
  EXPECT_EQ(p.phase(), Phase::running);
  EXPECT_FALSE(p.over());
  EXPECT_FALSE(p.dead("boss"));
  EXPECT_TRUE(p.dead("a"));
  EXPECT_TRUE(p.dead("b"));
  EXPECT_FALSE(p.dead("c"));
  EXPECT_FALSE(p.dead("nobody"));
  m.phase = static_cast<int>(Phase::stopping);
  m.as_of = 44;
  supervisor.publish(m, 0);
  EXPECT_TRUE(p.over());
  EXPECT_EQ(p.stop_as_of(), 44);
}

TEST(Process, WhoLeadsObeysHisOwnWordWhateverComesByHisChannel) {
  test::DirectBus bus;
  NodeContext leader = context_of("boss");
  leader.roster = {"boss", "b"};
  Process p(bus, leader);
  supervisor_t word{};
  word.phase = static_cast<int>(Phase::running);
  p.lead(word);
  supervisor_t forged{};
  forged.header = {1, std::numeric_limits<std::int64_t>::max(), 0};
  forged.phase = static_cast<int>(Phase::finished);
  test::Bytes bytes(static_cast<std::size_t>(encoded_size<supervisor_t>()));
  forged.encode(bytes.data(), 0, encoded_size<supervisor_t>());
  bus.deliver(p.route("supervisor").channel, bytes);
  EXPECT_EQ(p.phase(), Phase::running);
  word.phase = static_cast<int>(Phase::stopping);
  word.as_of = 7;
  p.lead(word);
  EXPECT_EQ(p.phase(), Phase::stopping);
  EXPECT_EQ(p.stop_as_of(), 7);
}

/// A supervisor that speaks until he is silenced.
struct Speaker {
  explicit Speaker(MemoryHub& hub)
      : bus(hub.open()), out(*bus, {Group::agents, context_of("b").session + ".supervisor"}, 1) {}
  void say(Phase phase) {
    supervisor_t m{};
    m.phase = static_cast<int>(phase);
    out.publish(m, 0);
  }
  std::unique_ptr<Bus> bus;
  Outbox<supervisor_t> out;
};

/// @return the context of a node whose supervisor is another process
NodeContext node(ClockKind clock) {
  NodeContext m = context_of("b");
  m.roster = {"boss", "b"};
  m.clock = clock;
  m.timeout = std::chrono::milliseconds(1000);
  return m;
}

TEST(Process, EchoesWhatItHasHeardOfTheSupervisorAtOnce) {
  MemoryHub hub;
  Speaker boss(hub);
  const auto bus = hub.open();
  Process p(*bus, node(ClockKind::step));
  Queue<process_status_t> told(*boss.bus, p.route("b.status"), 1);
  boss.say(Phase::stopping);
  p.await([] { return false; }, Process::Clock::now() + std::chrono::milliseconds(5));
  boss.bus->wait(std::chrono::milliseconds(100));
  std::optional<process_status_t> last;
  while (const auto s = told.take()) last = s;
  ASSERT_TRUE(last);
  EXPECT_EQ(last->phase, static_cast<int>(Phase::stopping));
  EXPECT_EQ(last->as_of, 0);
}

TEST(Process, ByTheWallClockComesToRestWithinASecondOfTheSupervisorsSilenceAndNamesHim) {
  if (kReceiveTimeout.count() == 0) GTEST_SKIP() << "under sanitizers nobody is judged by the wall clock";
  MemoryHub hub;
  Speaker boss(hub);
  const auto bus = hub.open();
  Process p(*bus, node(ClockKind::wall));
  Queue<process_status_t> told(*boss.bus, p.route("b.status"), 1);
  boss.say(Phase::running);
  const auto silent_since = Process::Clock::now();
  EXPECT_FALSE(p.await([&] { return p.over(); }, silent_since + std::chrono::milliseconds(500)));
  EXPECT_TRUE(p.await([&] { return p.over(); }, silent_since + std::chrono::seconds(5)));
  EXPECT_LT(Process::Clock::now() - silent_since, std::chrono::seconds(1));
  EXPECT_EQ(p.stop_as_of(), 0);
  p.report_done();
  boss.say(Phase::running);  // he is back: too late
  p.await([] { return false; }, Process::Clock::now() + std::chrono::milliseconds(30));
  EXPECT_TRUE(p.over());
  while (boss.bus->wait(std::chrono::milliseconds(0))) {
  }
  std::optional<process_status_t> last;
  while (const auto s = told.take()) last = s;
  ASSERT_TRUE(last);
  EXPECT_EQ(last->state, static_cast<int>(ProcessState::faulted)) << "report_done() does not make it good";
  EXPECT_EQ(last->fault.code, static_cast<int>(FaultCode::supervisor_silent));
  EXPECT_EQ(get_text(last->fault.process), "boss");
  boss.say(Phase::finished);
  p.stay();
}

TEST(Process, InLockStepTheTimeInWhichTheSupervisorIsSilentIsNotWaitedInVain) {
  if (kReceiveTimeout.count() == 0) GTEST_SKIP() << "under sanitizers a wait has no end";
  MemoryHub hub;
  Speaker boss(hub);
  const auto bus = hub.open();
  Process p(*bus, node(ClockKind::step));
  const auto in = p.inbox<operator_order_t>("beat");
  const Sources sources{in.get()};
  boss.say(Phase::running);
  const auto begun = Process::Clock::now();
  const auto suspended = [&] { return Process::Clock::now() - begun > std::chrono::milliseconds(1800); };
  EXPECT_NO_THROW(p.await_from(sources, FaultCode::peer_silent, suspended)) << "longer than its timeout";
  const auto speaks = [&] {
    boss.say(Phase::running);
    return false;
  };
  EXPECT_THROW(p.await_from(sources, FaultCode::peer_silent, speaks), FaultError)
      << "he is there, and nothing comes";
}

TEST(Process, GivesUpAtItsDeadline) {
  test::DirectBus bus;
  Process p(bus, context_of("b"));
  int asked = 0;
  EXPECT_FALSE(p.await(
      [&] {
        ++asked;
        return false;
      },
      Process::Clock::now()));
  EXPECT_GE(asked, 1);
  EXPECT_LE(asked, 2);
  EXPECT_TRUE(p.await([&] { return ++asked > 5; }));
}

TEST(Process, MoreLinksThanFitIntoAStatusAreRefused) {
  test::DirectBus bus;
  Process p(bus, context_of("b"));
  std::vector<std::unique_ptr<Outbox<operator_order_t>>> boxes;
  const auto room = static_cast<int>(std::size(process_status_t{}.hash));
  for (int k = 0; k < room; ++k) boxes.push_back(p.outbox<operator_order_t>("x" + std::to_string(k)));
  EXPECT_THROW(boxes.push_back(p.outbox<operator_order_t>("one too many")), FaultError);
  p.report_done();
}

}  // namespace
}  // namespace mrroc::link
