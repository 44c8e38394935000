// Writes numbers of things: "1 stroke", "2 strokes".
#pragma once
#include <concepts>
#include <string>
#include <string_view>

namespace mrroc {

/// @param thing   one of them: "stroke"
/// @param plural  several of them; empty: with an s
/// @return "1 stroke", "2 strokes", "0 strokes"
template <std::integral Number>
[[nodiscard]] std::string counted(Number number, std::string_view thing, std::string_view plural = {}) {
  std::string text = std::to_string(number) + " ";
  if (number == 1 || !plural.empty()) return text.append(number == 1 ? thing : plural);
  return text.append(thing) + "s";
}

}  // namespace mrroc
