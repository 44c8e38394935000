// Inbox, Outbox and Queue: only whole messages of the own session with new numbers count.
#include "base/link/channel.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "base/link/lossy_bus.hpp"
#include "mrroc/operator_order_t.hpp"
#include "mrroc/sensor_reading_t.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

using test::Bytes;
using test::DirectBus;
using M = operator_order_t;

const Route kRoute{Group::agents, "s.a"};
constexpr std::int64_t kSession = 77;

M message(std::int64_t id) {
  M m{};
  m.id = id;
  return m;
}

Bytes encoded(const M& m) {
  Bytes bytes(static_cast<std::size_t>(encoded_size<M>()));
  m.encode(bytes.data(), 0, encoded_size<M>());
  return bytes;
}

Bytes encoded(std::int64_t session, std::int64_t number, std::int64_t stamp, std::int64_t id) {
  M m = message(id);
  m.header.session = session;
  m.header.number = number;
  m.header.stamp = stamp;
  return encoded(m);
}

struct Ends {
  DirectBus bus;
  Inbox<M> in{bus, kRoute, kSession};
  Outbox<M> out{bus, kRoute, kSession};
  void give(const Bytes& bytes) { bus.deliver(kRoute.channel, bytes); }
};

TEST(Channel, GivesEveryMessageUnderItsStamp) {
  Ends e;
  for (std::int64_t stamp = 1; stamp <= 100; ++stamp) {
    EXPECT_EQ(e.in.at(stamp), nullptr);
    e.out.publish(message(1000 + stamp), stamp);
    ASSERT_NE(e.in.at(stamp), nullptr);
    EXPECT_EQ(e.in.at(stamp)->id, 1000 + stamp);
    EXPECT_EQ(e.in.newest(), e.in.at(stamp));
    if (stamp >= Inbox<M>::kDepth) {
      EXPECT_EQ(e.in.at(stamp - Inbox<M>::kDepth + 1)->id, 1000 + stamp - Inbox<M>::kDepth + 1);
      EXPECT_EQ(e.in.at(stamp - Inbox<M>::kDepth), nullptr);
    }
  }
  EXPECT_EQ(e.in.counters().received, 100);
  EXPECT_EQ(e.in.counters().gaps, 0);
  EXPECT_EQ(e.out.count(), 100);
}

TEST(Channel, AnEmptyInboxHasNothingForAnyStamp) {
  Ends e;
  EXPECT_EQ(e.in.newest(), nullptr);
  for (const std::int64_t stamp : {0, 1, -1, 16}) EXPECT_EQ(e.in.at(stamp), nullptr);
}

TEST(Channel, NextIsTheOldestThatHasNotBeenMissed) {
  Ends e;
  EXPECT_EQ(e.in.next(0), nullptr);
  for (const std::int64_t stamp : {3, 5, 6}) e.out.publish(message(100 + stamp), stamp);
  EXPECT_EQ(e.in.next(1)->id, 103);
  EXPECT_EQ(e.in.next(3)->id, 103);
  EXPECT_EQ(e.in.next(4)->id, 105);
  EXPECT_EQ(e.in.next(7), nullptr);
  for (std::int64_t stamp = 7; stamp <= 40; ++stamp) e.out.publish(message(100 + stamp), stamp);
  EXPECT_EQ(e.in.next(7)->id, 100 + 40 - Inbox<M>::kDepth + 1);
}

TEST(Channel, ForeignMalformedAndUnnumberedMessagesNeverAct) {
  Ends e;
  e.give(encoded(kSession + 1, 1, 5, 9));
  e.give(encoded(0, 1, 5, 9));
  EXPECT_EQ(e.in.counters().foreign, 2);
  e.give(encoded(kSession, 0, 5, 9));
  e.give(encoded(kSession, -3, 5, 9));
  Bytes whole = encoded(kSession, 1, 5, 9);
  for (std::size_t n = 0; n < whole.size(); ++n)
    e.give(Bytes(whole.begin(), whole.begin() + static_cast<long>(n)));
  Bytes longer = whole;
  longer.push_back(0);
  e.give(longer);
  Bytes other_type = whole;
  other_type[0] ^= 1;
  e.give(other_type);
  EXPECT_EQ(e.in.counters().malformed, static_cast<std::int64_t>(2 + whole.size() + 2));
  EXPECT_EQ(e.in.newest(), nullptr);
  EXPECT_EQ(e.in.at(5), nullptr);
  e.give(whole);
  EXPECT_EQ(e.in.at(5)->id, 9);
}

TEST(Channel, AMessageOfAnotherTypeIsDropped) {
  Ends e;
  Outbox<sensor_reading_t> stranger(e.bus, kRoute, kSession);
  stranger.publish({}, 1);
  EXPECT_EQ(e.in.newest(), nullptr);
  EXPECT_EQ(e.in.counters().malformed, 1);
}

TEST(Channel, RandomBytesNeverAct) {
  Ends e;
  std::mt19937_64 random(1);
  const Bytes whole = encoded(kSession, 1, 5, 9);
  for (int k = 0; k < 20000; ++k) {
    Bytes bytes = whole;
    if (k % 2) bytes.resize(random() % (2 * whole.size()));
    for (auto& b : bytes) b = static_cast<std::uint8_t>(random());
    e.give(bytes);
  }
  EXPECT_EQ(e.in.newest(), nullptr);
  EXPECT_EQ(e.in.counters().received, 0);
}

TEST(Channel, OldAndRepeatedMessagesNeverAct) {
  Ends e;
  std::vector<Bytes> sent;
  for (std::int64_t n = 1; n <= 40; ++n) {
    sent.push_back(encoded(kSession, n, n, 100 + n));
    e.give(sent.back());
    for (const Bytes& old : sent) e.give(old);
    EXPECT_EQ(e.in.newest()->id, 100 + n);
    for (std::int64_t stamp = 1; stamp <= n; ++stamp)
      EXPECT_TRUE(!e.in.at(stamp) || e.in.at(stamp)->id == 100 + stamp);
  }
  EXPECT_EQ(e.in.counters().received, 40);
  EXPECT_EQ(e.in.counters().repeated, 40 * 41 / 2);
  EXPECT_EQ(e.in.counters().gaps, 0);
}

TEST(Channel, ANewerMessageForTheSameStampReplacesTheOlder) {
  Ends e;
  e.give(encoded(kSession, 1, 0, 10));
  e.give(encoded(kSession, 3, 0, 30));
  e.give(encoded(kSession, 2, 0, 20));
  EXPECT_EQ(e.in.newest()->id, 30);
  EXPECT_EQ(e.in.at(0)->id, 30);
}

TEST(Channel, AMessageThatWasOvertakenIsTakenAfterAll) {
  Ends e;
  e.give(encoded(kSession, 1, 1, 10));
  e.give(encoded(kSession, 4, 4, 40));
  EXPECT_EQ(e.in.counters().gaps, 2);
  e.give(encoded(kSession, 3, 3, 30));
  e.give(encoded(kSession, 2, 2, 20));
  EXPECT_EQ(e.in.counters().gaps, 0);
  EXPECT_EQ(e.in.newest()->id, 40);
  EXPECT_EQ(e.in.at(2)->id, 20);
  EXPECT_EQ(e.in.at(3)->id, 30);
}

TEST(Channel, ResendingRepairsLossAndNeverActsTwice) {
  std::mt19937_64 random(3);
  DirectBus bus;
  LossyBus lossy(bus, [&] { return random() % 2 == 0; });
  Inbox<M> in(bus, kRoute, kSession);
  Outbox<M> out(lossy, kRoute, kSession);
  for (std::int64_t stamp = 1; stamp <= 2000; ++stamp) {
    out.publish(message(stamp), stamp);
    for (int tries = 0; !in.at(stamp); ++tries) {
      ASSERT_LT(tries, 200);
      out.repeat();
    }
    EXPECT_EQ(in.at(stamp)->id, stamp);
  }
  EXPECT_EQ(in.counters().received, 2000);
  EXPECT_EQ(in.counters().gaps, 0);
}

TEST(Channel, RepeatingSendsTheLastKeptMessagesAsTheyWere) {
  Ends e;
  e.out.repeat();
  EXPECT_TRUE(e.bus.published.empty());
  for (std::int64_t stamp = 1; stamp <= 9; ++stamp) e.out.publish(message(stamp), stamp);
  const auto first = e.bus.published;
  e.bus.published.clear();
  const std::uint64_t hash = e.out.hash();
  e.out.repeat();
  ASSERT_EQ(e.bus.published.size(), Outbox<M>::kKept);
  for (std::size_t k = 0; k < Outbox<M>::kKept; ++k)
    EXPECT_EQ(e.bus.published[k], first[first.size() - Outbox<M>::kKept + k]);
  EXPECT_EQ(e.out.hash(), hash);
  EXPECT_EQ(e.out.count(), 9);
}

TEST(Channel, HashIsThatOfTheTrafficAndNotOfTheSession) {
  DirectBus bus;
  Outbox<M> a(bus, kRoute, 1), b(bus, {Group::agents, "other"}, 999), c(bus, kRoute, 1), d(bus, kRoute, 1);
  for (std::int64_t stamp = 1; stamp <= 5; ++stamp) {
    a.publish(message(stamp), stamp);
    b.publish(message(stamp), stamp);
    c.publish(message(stamp == 3 ? 4 : stamp), stamp);
    d.publish(message(stamp), stamp + 1);
  }
  EXPECT_EQ(a.hash(), b.hash());
  EXPECT_NE(a.hash(), c.hash());
  EXPECT_NE(a.hash(), d.hash());
  b.publish(message(6), 6);
  EXPECT_NE(a.hash(), b.hash());
}

const Route kOfSeveral{Group::agents, "s.operator"};

TEST(Queue, OfOneSenderTakesEveryNumberOnce) {
  DirectBus bus;
  Queue<M> queue(bus, kRoute, kSession);
  for (const std::int64_t number : {1, 3, 2, 3, 1, 2, 4})
    bus.deliver(kRoute.channel, encoded(kSession, number, 0, number));
  for (const std::int64_t number : {1, 3, 2, 4}) EXPECT_EQ(queue.take()->id, number);
  EXPECT_FALSE(queue.take());
}

TEST(Queue, OfOneSenderTakesNoNumberThatNoneGives) {
  DirectBus bus;
  Queue<M> queue(bus, kRoute, kSession);
  for (const std::int64_t number :
       {std::int64_t{0}, std::int64_t{-1}, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max(), kMostSkipped + 1})
    bus.deliver(kRoute.channel, encoded(kSession, number, 0, 0));
  EXPECT_FALSE(queue.take());
  bus.deliver(kRoute.channel, encoded(kSession, 1, 0, 5));
  EXPECT_EQ(queue.take()->id, 5);
}

TEST(Queue, OfOneSenderTakesNumbersAsLargeAsALongRunGives) {
  DirectBus bus;
  Queue<M> queue(bus, kRoute, kSession);
  for (std::int64_t k = 1; k <= 5; ++k) {
    bus.deliver(kRoute.channel, encoded(kSession, k * kMostSkipped, 0, k));
    const auto m = queue.take();
    ASSERT_TRUE(m);
    EXPECT_EQ(m->id, k);
  }
}

TEST(Channel, ANumberThatJumpsIsRefusedAndTheLinkGoesOn) {
  Ends e;
  e.out.publish(message(1), 1);
  for (const std::int64_t number : {std::numeric_limits<std::int64_t>::max(), 1 + kMostSkipped + 1})
    e.give(encoded(kSession, number, 2, 666));
  EXPECT_EQ(e.in.counters().malformed, 2);
  e.out.publish(message(2), 2);
  EXPECT_EQ(e.in.newest()->id, 2);
  EXPECT_EQ(e.in.counters().gaps, 0);
  e.give(encoded(kSession, 2 + kMostSkipped, 3, 3));
  EXPECT_EQ(e.in.newest()->id, 3) << "as far as a receiver can sleep";
}

TEST(Channel, AStampBeyondAllBoundsIsRefused) {
  Ends e;
  for (const std::int64_t stamp :
       {std::int64_t{-2}, kLargestStamp + 1, std::numeric_limits<std::int64_t>::min(),
        std::numeric_limits<std::int64_t>::max()})
    e.give(encoded(kSession, 1, stamp, 666));
  EXPECT_EQ(e.in.counters().malformed, 4);
  e.give(encoded(kSession, 1, -1, 5));
  ASSERT_NE(e.in.newest(), nullptr);
  EXPECT_EQ(e.in.newest()->id, 5);
}

TEST(Queue, GivesEveryMessageOnceInOrderOfArrival) {
  DirectBus bus;
  Queue<M> queue(bus, kOfSeveral, kSession);
  Outbox<M> one(bus, kOfSeveral, kSession), two(bus, kOfSeveral, kSession),
      foreign(bus, kOfSeveral, kSession + 1);
  EXPECT_FALSE(queue.take());
  for (int k = 0; k < 10; ++k) {
    one.publish(message(2 * k), 0);
    foreign.publish(message(-1), 0);
    two.publish(message(2 * k + 1), 0);
    bus.deliver(kOfSeveral.channel, Bytes(7));
  }
  for (int k = 0; k < 20; ++k) EXPECT_EQ(queue.take()->id, k);
  EXPECT_FALSE(queue.take());
}

TEST(Queue, AFloodDoesNotGrowWithoutBound) {
  DirectBus bus;
  Queue<M> queue(bus, kOfSeveral, kSession);
  const Bytes bytes = encoded(kSession, 1, 1, 1);
  for (int k = 0; k < 30000; ++k) bus.deliver(kOfSeveral.channel, bytes);
  int taken = 0;
  while (queue.take()) ++taken;
  EXPECT_EQ(taken, 10000);
}

}  // namespace
}  // namespace mrroc::link
