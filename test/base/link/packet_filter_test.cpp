// The filter of a socket, run here instead of in the kernel: what it lets pass.
#include "base/link/packet_filter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "base/link/lcm_packet.hpp"

namespace mrroc::link {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// A datagram behind its UDP header, as a filter sees it.
Bytes packet(const std::string& channel, std::size_t message) {
  Bytes datagram, all(8, 0xee);
  write_packet(datagram, 3, channel, Bytes(message, 0x55));
  all.insert(all.end(), datagram.begin(), datagram.end());
  return all;
}

/// Executes the instructions that filters are made of, as the kernel does. @return bytes that pass; 0: none
std::uint32_t passes(const std::vector<sock_filter>& program, const Bytes& bytes) {
  std::uint32_t a = 0;
  for (std::size_t at = 0; at < program.size(); ++at) {
    const sock_filter& f = program[at];
    const auto load = [&](std::size_t size) {
      if (f.k + size > bytes.size()) return false;
      a = 0;
      for (std::size_t k = 0; k < size; ++k) a = a << 8U | bytes[f.k + k];
      return true;
    };
    switch (f.code) {
      case BPF_LD | BPF_W | BPF_LEN:
        a = static_cast<std::uint32_t>(bytes.size());
        break;
      case BPF_ABS | BPF_W:  // BPF_LD is 0
        if (!load(4)) return 0;
        break;
      case BPF_LD | BPF_ABS | BPF_H:
        if (!load(2)) return 0;
        break;
      case BPF_LD | BPF_ABS | BPF_B:
        if (!load(1)) return 0;
        break;
      case BPF_JMP | BPF_JGT | BPF_K:
        at += a > f.k ? f.jt : f.jf;
        break;
      case BPF_JMP | BPF_JEQ | BPF_K:
        at += a == f.k ? f.jt : f.jf;
        break;
      case BPF_RET | BPF_K:
        return f.k;
      default:
        ADD_FAILURE() << "an instruction that this test does not know: " << f.code;
        return 0;
    }
  }
  ADD_FAILURE() << "the program runs over its end";
  return 0;
}

TEST(PacketFilter, LetsPassTheChannelsThatAreWantedAndNoOthers) {
  std::mt19937 random(1);
  const auto name = [&] {
    std::string text(1 + random() % 12, 'a');
    for (char& c : text) c = static_cast<char>('a' + random() % 2);  // many have a beginning in common
    return text;
  };
  for (int round = 0; round < 100; ++round) {
    std::vector<std::string> wanted(1 + random() % 6);
    for (std::string& w : wanted) w = name();
    const auto program = packet_filter(1000, wanted);
    for (const std::string& w : wanted) EXPECT_EQ(passes(program, packet(w, 40)), 0xFFFFFFFF) << w;
    for (int k = 0; k < 50; ++k) {
      const std::string other = name();
      const bool is_wanted = std::find(wanted.begin(), wanted.end(), other) != wanted.end();
      EXPECT_EQ(passes(program, packet(other, 40)) != 0, is_wanted) << other;
    }
  }
}

TEST(PacketFilter, WithoutChannelsEveryPacketPasses) {
  const auto program = packet_filter(1000, {});
  EXPECT_NE(passes(program, packet("anything", 0)), 0U);
  Bytes other = packet("anything", 40);
  for (std::size_t k = 8; k < 12; ++k) {
    Bytes spoilt = other;
    spoilt[k] ^= 1;
    EXPECT_EQ(passes(program, spoilt), 0U) << "no packet of LCM";
  }
  EXPECT_EQ(passes(program, Bytes(8)), 0U);
  EXPECT_EQ(passes(program, Bytes(11)), 0U);
}

TEST(PacketFilter, WhatIsLargerThanAnyMessageDoesNotPass) {
  for (const std::vector<std::string>& channels : {std::vector<std::string>{}, {"s.a"}}) {
    const auto program = packet_filter(100, channels);
    const std::size_t without = packet("s.a", 0).size() - 8;  // of LCM's header and the channel
    EXPECT_NE(passes(program, packet("s.a", 100 - without)), 0U);
    EXPECT_EQ(passes(program, packet("s.a", 101 - without)), 0U);
  }
  const auto all = packet_filter(10'000'000, {});
  EXPECT_NE(passes(all, Bytes(packet("a", kLargestDatagram - kPacketHeader - 2))), 0U);
  EXPECT_EQ(passes(all, Bytes(packet("a", kLargestDatagram - kPacketHeader - 1))), 0U);
}

TEST(PacketFilter, OfMoreChannelsThanTheKernelCanKnowAllPass) {
  std::vector<std::string> many;
  for (int k = 0; k < 3000; ++k) many.push_back("session.channel" + std::to_string(k));
  const auto program = packet_filter(1000, many);
  EXPECT_LE(program.size(), static_cast<std::size_t>(BPF_MAXINSNS));
  EXPECT_NE(passes(program, packet("another", 4)), 0U);
  const std::string longest(kLongestChannel, 'x');
  const auto two = packet_filter(1000, {longest + "x", longest});
  EXPECT_NE(passes(two, packet(longest, 4)), 0U);
  EXPECT_EQ(passes(two, packet("y", 4)), 0U);
}

}  // namespace
}  // namespace mrroc::link
