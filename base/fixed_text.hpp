// A short text of fixed size, for everything that travels in messages or is made in the servo step.
#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace mrroc {

/// At most N characters, zero-padded. Trivially copyable, no allocation; every function is real-time safe.
template <std::size_t N>
struct FixedText {
  std::array<char, N> data{};  ///< the characters; zero after the last one, no zero when the text is full

  constexpr FixedText() = default;
  /// Copies the text; what does not fit is cut off.
  constexpr FixedText(std::string_view text) {  // NOLINT(google-explicit-constructor): stands for a text
    std::copy_n(text.begin(), std::min(text.size(), N), data.begin());
  }
  constexpr FixedText(const char* text) : FixedText(std::string_view(text)) {}

  /// @return the characters before the first zero; valid as long as this object
  [[nodiscard]] constexpr std::string_view view() const {
    return {data.data(), static_cast<std::size_t>(std::find(data.begin(), data.end(), '\0') - data.begin())};
  }
  [[nodiscard]] constexpr bool empty() const { return view().empty(); }

  friend constexpr bool operator==(const FixedText& a, const FixedText& b) { return a.view() == b.view(); }
};

}  // namespace mrroc
