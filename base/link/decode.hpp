// Messages that are safe to decode from any bytes.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

namespace mrroc::link {

/// A message of fixed size. lcm-gen turns strings and variable arrays into types whose decoders abort or
/// overrun on a bad length; fixed-size fields cannot. Every message begins with a header_t.
template <class M>
concept FixedMessage = std::is_trivially_copyable_v<M> && requires(M m) {
  M::getHash();
  m.header.stamp;
};

/// @return size of M on the wire [bytes]
template <FixedMessage M>
int encoded_size() {
  static const int size = M{}.getEncodedSize();
  return size;
}

/// @return the message, or nothing unless the bytes are exactly one M
template <FixedMessage M>
std::optional<M> decode(std::span<const std::uint8_t> bytes) noexcept {
  const int exact = encoded_size<M>();
  M m{};
  if (bytes.size() != static_cast<std::size_t>(exact) || m.decode(bytes.data(), 0, exact) != exact)
    return std::nullopt;
  return m;
}

}  // namespace mrroc::link
