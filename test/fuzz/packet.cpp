// Datagrams: what is read is a short packet, and written again the same bytes.
#include <algorithm>
#include <span>
#include <vector>

#include "base/link/lcm_packet.hpp"
#include "test/fuzz/fuzz.hpp"

using namespace mrroc;

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::span<const std::uint8_t> datagram(data, size);
  const auto packet = link::read_packet(datagram);
  if (!packet) return 0;
  fuzz::require(!packet->channel.empty() && packet->channel.size() <= link::kLongestChannel &&
                    packet->channel.find('\0') == std::string_view::npos,
                "a channel has 1 to 63 characters");
  std::vector<std::uint8_t> again(datagram.begin(), datagram.begin() + link::kPacketHeader);
  again.insert(again.end(), packet->channel.begin(), packet->channel.end());
  again.push_back(0);
  again.insert(again.end(), packet->bytes.begin(), packet->bytes.end());
  fuzz::require(std::ranges::equal(again, datagram), "header, channel and message are the whole datagram");
  return 0;
}
