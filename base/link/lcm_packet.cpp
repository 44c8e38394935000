#include "base/link/lcm_packet.hpp"

#include <algorithm>
#include <array>

namespace mrroc::link {
namespace {

void put(std::vector<std::uint8_t>& bytes, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(word >> shift));
}

}  // namespace

std::optional<LcmPacket> read_packet(std::span<const std::uint8_t> datagram) noexcept {
  constexpr std::array<std::uint8_t, 4> kMagic{'L', 'C', '0', '2'};
  if (datagram.size() < kPacketHeader || !std::ranges::equal(datagram.first(kMagic.size()), kMagic))
    return {};
  const auto rest = datagram.subspan(kPacketHeader);
  const auto name = rest.first(std::min(rest.size(), kLongestChannel + 1));
  const auto length = static_cast<std::size_t>(std::ranges::find(name, 0) - name.begin());
  if (length == 0 || length == name.size()) return {};
  return LcmPacket{{reinterpret_cast<const char*>(name.data()), length}, rest.subspan(length + 1)};
}

void write_packet(std::vector<std::uint8_t>& datagram, std::uint32_t number, std::string_view channel,
                  std::span<const std::uint8_t> bytes) {
  datagram.clear();
  put(datagram, kPacketMagic);
  put(datagram, number);
  datagram.insert(datagram.end(), channel.begin(), channel.end());
  datagram.push_back(0);
  datagram.insert(datagram.end(), bytes.begin(), bytes.end());
}

}  // namespace mrroc::link
