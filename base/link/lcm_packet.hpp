// Reads and writes LCM's short packets: a magic number, a running number, the channel's name with a NUL, then
// the message. Anybody on the host can send anything, so nothing else is read.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace mrroc::link {

/// Largest datagram that UDP can carry [bytes].
inline constexpr std::size_t kLargestDatagram = 65507;
/// Longest name of a channel in LCM, without the NUL [characters].
inline constexpr std::size_t kLongestChannel = 63;
/// First four bytes of a short packet: LC02.
inline constexpr std::uint32_t kPacketMagic = 0x4C433032;
/// Bytes before the name of the channel.
inline constexpr std::size_t kPacketHeader = 8;
/// Largest message that LCM sends as one packet, with any channel's name, and what authentication.hpp adds [bytes].
inline constexpr std::size_t kLargestMessage = 65499 - kLongestChannel - 1 - 32;

/// One message in a datagram. It points into it.
struct LcmPacket {
  std::string_view channel;             ///< without the NUL, 1..kLongestChannel characters
  std::span<const std::uint8_t> bytes;  ///< of the message
};

/// @param datagram  any bytes
/// @return what is in it, or nothing unless it is a short packet. Fragments of larger messages are none: no message
///         here is larger, and pieces that somebody else numbers cannot be put together safely
[[nodiscard]] std::optional<LcmPacket> read_packet(std::span<const std::uint8_t> datagram) noexcept;

/// Makes such a datagram, as LCM does.
/// @param datagram  becomes it  @param number  of the packet, for LCM's tools  @param channel  1..kLongestChannel characters
void write_packet(std::vector<std::uint8_t>& datagram, std::uint32_t number, std::string_view channel,
                  std::span<const std::uint8_t> bytes);

}  // namespace mrroc::link
