// 64-bit FNV-1a, for fingerprints of runs; not cryptographic.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>

namespace mrroc {

/// Fingerprint that grows byte by byte. Real-time safe.
class Hash {
 public:
  /// Takes in more bytes: those of a message, those of a text, or a number from its lowest byte on.
  constexpr void add(std::span<const std::uint8_t> bytes) noexcept {
    for (const std::uint8_t b : bytes) value_ = (value_ ^ b) * 0x100000001b3ULL;
  }
  constexpr void add(std::string_view text) noexcept {
    for (const char ch : text) value_ = (value_ ^ static_cast<std::uint8_t>(ch)) * 0x100000001b3ULL;
  }
  constexpr void add(std::uint64_t number) noexcept {
    for (int k = 0; k < 8; ++k) value_ = (value_ ^ ((number >> (8 * k)) & 0xff)) * 0x100000001b3ULL;
  }
  /// @return fingerprint of all that was added
  [[nodiscard]] constexpr std::uint64_t value() const noexcept { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

}  // namespace mrroc
