// Text in messages: fixed arrays of int8_t.
#pragma once
#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

namespace mrroc::link {

/// Copies the text into the field; what does not fit is cut off.
template <std::size_t N>
void put_text(std::int8_t (&field)[N], std::string_view text) {
  const std::size_t n = std::min(text.size(), N);
  std::copy_n(text.begin(), n, field);
  std::fill(field + n, field + N, std::int8_t{0});
}

/// @return the characters before the first zero; those that are not printable are shown as '?'
template <std::size_t N>
std::string get_text(const std::int8_t (&field)[N]) {
  std::string text;
  for (const std::int8_t ch : field) {
    if (ch == 0) break;
    text += ch >= ' ' && ch < 127 ? static_cast<char>(ch) : '?';
  }
  return text;
}

}  // namespace mrroc::link
