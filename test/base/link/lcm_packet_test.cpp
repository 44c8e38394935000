// Parsing of datagrams that anybody on the host may have sent.
#include "base/link/lcm_packet.hpp"

#include <gtest/gtest.h>

#include <random>

#include "test/base/link/buses.hpp"

namespace mrroc::link {
namespace {

using test::Bytes;

/// @return a datagram as LCM makes it
Bytes short_packet(const std::string& channel, const Bytes& message) {
  Bytes d{'L', 'C', '0', '2', 0, 0, 0, 7};
  d.insert(d.end(), channel.begin(), channel.end());
  d.push_back(0);
  d.insert(d.end(), message.begin(), message.end());
  return d;
}

TEST(LcmPacket, AShortPacketIsItsChannelAndItsMessage) {
  const Bytes d = short_packet("s.a", {1, 0, 2});
  const auto p = read_packet(d);
  ASSERT_TRUE(p);
  EXPECT_EQ(p->channel, "s.a");
  EXPECT_EQ(Bytes(p->bytes.begin(), p->bytes.end()), (Bytes{1, 0, 2}));
  EXPECT_TRUE(read_packet(short_packet(std::string(kLongestChannel, 'x'), {})));
}

TEST(LcmPacket, EverythingElseIsNone) {
  EXPECT_FALSE(read_packet({}));
  EXPECT_FALSE(read_packet(short_packet("", {1}))) << "no channel";
  EXPECT_FALSE(read_packet(short_packet(std::string(kLongestChannel + 1, 'x'), {1})));
  const Bytes whole = short_packet("s.a", {});
  for (std::size_t n = 0; n < whole.size(); ++n)
    EXPECT_FALSE(read_packet(std::span(whole).first(n))) << "cut off after " << n;
  Bytes fragment = short_packet("s.a", {1});
  fragment[3] = '3';
  EXPECT_FALSE(read_packet(fragment)) << "a piece of a larger message";
}

TEST(LcmPacket, WhatIsReadLiesWithinAnyDatagram) {
  std::mt19937_64 random(1);
  for (int k = 0; k < 100000; ++k) {
    Bytes d(random() % 100);
    for (auto& b : d) b = static_cast<std::uint8_t>(random() % 3 == 0 ? 0 : random());
    if (d.size() >= 4 && random() % 2) std::copy_n("LC02", 4, d.begin());
    const auto p = read_packet(d);
    if (!p) continue;
    ASSERT_EQ(kPacketHeader + p->channel.size() + 1 + p->bytes.size(), d.size());
    ASSERT_EQ(p->channel.find('\0'), std::string_view::npos);
    ASSERT_FALSE(p->channel.empty());
  }
}

}  // namespace
}  // namespace mrroc::link
