// Text in messages: fixed arrays of int8_t.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/printable.hpp"

namespace mrroc::link {

/// Copies the text into the field; what does not fit is cut off.
template <std::size_t N>
void put_text(std::int8_t (&field)[N], std::string_view text) {
  const std::size_t n = std::min(text.size(), N);
  std::copy_n(text.begin(), n, field);
  std::fill(field + n, field + N, std::int8_t{0});
}

/// @return the characters before the first zero, without control characters (base/printable.hpp)
template <std::size_t N>
std::string get_text(const std::int8_t (&field)[N]) {
  const std::string_view whole(reinterpret_cast<const char*>(field), N);
  return without_controls(whole.substr(0, whole.find('\0')));
}

}  // namespace mrroc::link
