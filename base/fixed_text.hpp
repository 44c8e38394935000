// A short text of fixed size, for messages and for the servo step.
#pragma once
#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <string_view>

namespace mrroc {

/// At most N characters, zero-padded. Trivially copyable, no allocation; every function is real-time safe.
template <std::size_t N>
struct FixedText {
  std::array<char, N> data{};  ///< the characters; zero after the last one, no zero when the text is full

  constexpr FixedText() = default;
  /// Copies the text; what does not fit is cut off.
  template <std::convertible_to<std::string_view> T>
  constexpr FixedText(const T& text) {  // NOLINT(google-explicit-constructor): stands for a text
    const std::string_view view = text;
    std::copy_n(view.begin(), std::min(view.size(), N), data.begin());
  }

  /// @return the characters before the first zero; valid as long as this object
  [[nodiscard]] constexpr std::string_view view() const {
    return {data.data(), static_cast<std::size_t>(std::find(data.begin(), data.end(), '\0') - data.begin())};
  }
  /// No character before the first zero.
  [[nodiscard]] constexpr bool empty() const { return view().empty(); }

  friend constexpr bool operator==(const FixedText& a, const FixedText& b) { return a.view() == b.view(); }
};

}  // namespace mrroc
