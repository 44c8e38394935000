// Joins texts with a separator.
#pragma once
#include <functional>
#include <string>
#include <string_view>

namespace mrroc {

/// Joins texts as fmt::join does; that one brings all of a library for numbers into every file that uses it.
/// @param things   a range
/// @param between  two of them, such as ", "
/// @param text     of a thing: what a std::string can be appended with; a member or a function, default: itself
/// @return "A, B, C"; empty: there are none
template <class Things, class Text = std::identity>
[[nodiscard]] std::string joined(const Things& things, std::string_view between, Text text = {}) {
  std::string all;
  bool first = true;
  for (const auto& thing : things) {
    if (!first) all += between;
    first = false;
    all += std::invoke(text, thing);
  }
  return all;
}

}  // namespace mrroc
