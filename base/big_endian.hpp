// Writes and reads numbers with the highest byte first, as LCM and the session's tags have them.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

namespace mrroc {

/// @param bytes  at most eight  @return the number; for a signed one, convert it
[[nodiscard]] constexpr std::uint64_t big_endian(std::span<const std::uint8_t> bytes) noexcept {
  std::uint64_t number = 0;
  for (const std::uint8_t b : bytes) number = number << 8U | b;
  return number;
}

/// Appends the eight bytes of a number.
inline void append_big_endian(std::vector<std::uint8_t>& bytes, std::uint64_t number) {
  for (int shift = 56; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(number >> shift));
}

}  // namespace mrroc
