// Datagrams are accepted that are made with the session's key and come for the first time, and no others.
#include "base/link/authentication.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "base/link/lcm_packet.hpp"
#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

using test::Bytes;

Bytes signed_packet(const TagKey& key, const Origin& origin, const std::string& channel = "s.a",
                    const Bytes& message = {1, 2, 3}) {
  Bytes d;
  write_packet(d, 7, channel, message);
  sign(d, origin, key);
  return d;
}

TEST(Authentication, WhoHasTheKeyIsKnownAndHisMessageStaysAsItIs) {
  const TagKey key(Key::random());
  const Bytes d = signed_packet(key, {0x0102030405060708, 9});
  EXPECT_EQ(authenticate(d, key), (Origin{0x0102030405060708, 9}));
  const auto p = read_packet(d);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->channel, "s.a");
  ASSERT_EQ(p->bytes.size(), 3 + kTrailer);
  EXPECT_EQ(Bytes(p->bytes.begin(), p->bytes.begin() + 3), (Bytes{1, 2, 3}));
}

TEST(Authentication, EveryBitOfChannelMessageAndTrailerCounts) {
  const TagKey key(Key::random());
  const Bytes right = signed_packet(key, {5, 6});
  for (std::size_t bit = 8 * kPacketHeader; bit < 8 * right.size(); ++bit) {
    Bytes d = right;
    d[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    EXPECT_FALSE(authenticate(d, key)) << "bit " << bit;
  }
}

TEST(Authentication, AnotherKeyIsNoKey) {
  const TagKey key(Key::random()), other(Key::random());
  EXPECT_FALSE(authenticate(signed_packet(other, {5, 6}), key));
}

TEST(Authentication, WhatIsCutOffOrLongerIsForged) {
  const TagKey key(Key::random());
  Bytes d = signed_packet(key, {5, 6});
  for (std::size_t n = 0; n < d.size(); ++n) EXPECT_FALSE(authenticate(std::span(d).first(n), key)) << n;
  d.push_back(0);
  EXPECT_FALSE(authenticate(d, key));
}

TEST(Authentication, NoRandomBytesAreTaken) {
  std::mt19937_64 random(1);
  const TagKey key(Key::random());
  for (int k = 0; k < 100000; ++k) {
    Bytes d(random() % 120);
    for (auto& b : d) b = static_cast<std::uint8_t>(random());
    ASSERT_FALSE(authenticate(d, key));
  }
}

TEST(ReplayWindow, TakesEveryNumberOnceInWhateverOrderWithinItsWidth) {
  std::mt19937_64 random(1);
  for (int round = 0; round < 200; ++round) {
    ReplayWindow window;
    std::set<std::uint64_t> taken;
    std::uint64_t highest = 0;
    for (int k = 0; k < 500; ++k) {
      const std::uint64_t n = highest + 3 > 200 ? highest + 3 - random() % 200 : 1 + random() % (highest + 3);
      const bool old = highest >= ReplayWindow::kWidth && n <= highest - ReplayWindow::kWidth;
      EXPECT_EQ(window.take(n), n > 0 && !old && !taken.contains(n)) << n << " after " << highest;
      taken.insert(n);
      highest = std::max(highest, n);
    }
  }
}

TEST(ReplayWindow, BearsAnyNumber) {
  ReplayWindow window;
  constexpr auto kLast = std::numeric_limits<std::uint64_t>::max();
  EXPECT_FALSE(window.take(0));
  EXPECT_TRUE(window.take(kLast - 1));
  EXPECT_TRUE(window.take(kLast));
  EXPECT_FALSE(window.take(kLast));
  EXPECT_FALSE(window.take(1));
  EXPECT_TRUE(window.take(kLast - 2));
}

TEST(SenderTable, CountsForEverySenderByItselfAndForAtMostSoMany) {
  SenderTable table;
  using Verdict = SenderTable::Verdict;
  EXPECT_EQ(table.take({1, 1}), Verdict::fresh);
  EXPECT_EQ(table.take({2, 1}), Verdict::fresh);
  EXPECT_EQ(table.take({1, 1}), Verdict::replayed);
  for (std::uint64_t sender = 3; sender <= SenderTable::kMost; ++sender)
    ASSERT_EQ(table.take({sender, 1}), Verdict::fresh);
  EXPECT_EQ(table.take({SenderTable::kMost + 1, 1}), Verdict::one_too_many);
  EXPECT_EQ(table.take({1, 2}), Verdict::fresh) << "whoever is known is still heard";
}

}  // namespace
}  // namespace mrroc::link
