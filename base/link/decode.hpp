// Decodes messages safely from any bytes.
#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>

#include "mrroc/header_t.hpp"

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

/// Numbers that a channel may skip: more than any receiver sleeps over.
inline constexpr std::int64_t kMostSkipped = 1'000'000;
/// Largest stamp [steps]: 63 years.
inline constexpr std::int64_t kLargestStamp = 1'000'000'000'000;

/// @param newest  highest number of the channel so far, 0: none
/// @return whether a sender that works can have written that: a number that jumps would make all later messages old ones
[[nodiscard]] constexpr bool plausible(const header_t& header, std::int64_t newest) noexcept {
  return header.number > 0 && header.number - newest <= kMostSkipped && header.stamp >= -1 &&
         header.stamp <= kLargestStamp;
}

}  // namespace mrroc::link
