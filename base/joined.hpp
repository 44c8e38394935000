// Texts one behind the other.
#pragma once
#include <string>
#include <string_view>

namespace mrroc {

/// What fmt::join does for texts; that one brings all of a library for numbers into every file that uses it.
/// @param texts    a range of what a std::string can be appended with
/// @param between  two of them, such as ", "
/// @return "A, B, C"; empty: there are none
template <class Texts>
[[nodiscard]] std::string joined(const Texts& texts, std::string_view between) {
  std::string all;
  bool first = true;
  for (const auto& text : texts) {
    if (!first) all += between;
    first = false;
    all += text;
  }
  return all;
}

}  // namespace mrroc
