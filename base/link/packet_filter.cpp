#include "base/link/packet_filter.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "base/link/lcm_packet.hpp"

namespace mrroc::link {
namespace {

constexpr std::uint32_t kUdpHeader = 8;  // what a filter sees before the datagram
constexpr std::uint32_t kPass = 0xFFFFFFFF, kDrop = 0;

/// Some bytes of a packet, as a filter loads them.
struct Word {
  std::uint16_t width;  // BPF_W, BPF_H or BPF_B
  std::uint32_t at, value;
};

std::vector<Word> words(std::string_view bytes, std::uint32_t at) {
  std::vector<Word> all;
  for (std::size_t size = 0; !bytes.empty(); bytes.remove_prefix(size)) {
    size = bytes.size() >= 4 ? 4 : bytes.size() >= 2 ? 2 : 1;
    Word w{static_cast<std::uint16_t>(size == 4 ? BPF_W : size == 2 ? BPF_H : BPF_B), at, 0};
    for (const char c : bytes.substr(0, size)) w.value = w.value << 8U | static_cast<std::uint8_t>(c);
    all.push_back(w);
    at += static_cast<std::uint32_t>(size);
  }
  return all;
}

/// Adds what lets a packet of that channel pass; for another one what follows is done.
void pass_channel(std::vector<sock_filter>& program, const std::string& channel) {
  const std::vector<Word> name = words({channel.c_str(), channel.size() + 1}, kUdpHeader + kPacketHeader);
  auto to_the_end = 2 * name.size();
  for (const Word& w : name) {
    to_the_end -= 2;
    program.push_back(BPF_STMT(static_cast<std::uint16_t>(BPF_LD | BPF_ABS | w.width), w.at));
    program.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, w.value, 0, static_cast<std::uint8_t>(to_the_end + 1)));
  }
  program.push_back(BPF_STMT(BPF_RET | BPF_K, kPass));
}

}  // namespace

std::vector<sock_filter> packet_filter(std::size_t largest, const std::vector<std::string>& channels) {
  const auto most = static_cast<std::uint32_t>(std::min(largest, kLargestDatagram)) + kUdpHeader;
  std::vector<sock_filter> program{
      BPF_STMT(BPF_LD | BPF_W | BPF_LEN, 0),
      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, most, 2, 0),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kUdpHeader),  // beyond the end: dropped
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kPacketMagic, 1, 0),
      BPF_STMT(BPF_RET | BPF_K, kDrop),
  };
  for (const std::string& c : channels)
    if (c.size() <= kLongestChannel) pass_channel(program, c);  // a longer one cannot be in a packet
  program.push_back(BPF_STMT(BPF_RET | BPF_K, channels.empty() ? kPass : kDrop));
  return program.size() <= BPF_MAXINSNS ? program : packet_filter(largest, {});
}

}  // namespace mrroc::link
