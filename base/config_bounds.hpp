// Limits how deep a configuration may be nested. The limit is checked before the TOML library sees the text:
// it follows keys and brackets by recursion, and a text of a few kilobytes would use up the stack.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace mrroc {

/// Largest text of a configuration [bytes]; that of the largest task has 20 thousand.
inline constexpr std::size_t kLargestConfig = 1'000'000;
/// Parts of one key, at most: "robots.arm1.tool.weight" has four.
inline constexpr int kMostKeyParts = 32;
/// Brackets and braces within one another, at most; a list of numbers has one.
inline constexpr int kDeepestBrackets = 8;
/// Characters of a key with its dots, at most; the longest that a task reads has 40.
inline constexpr std::size_t kLongestKey = 200;

/// The bound that a text exceeds, and the place.
struct ConfigExcess {
  int line{};         ///< counted from 1
  int column{};       ///< counted from 1
  std::string wrong;  ///< in words
};

/// @param toml  any bytes
/// @return the first place where the text is nested deeper than it may be; nothing when it is not, as far as it can be
///         read: behind the first place that surely is no TOML nothing is looked at
[[nodiscard]] std::optional<ConfigExcess> config_excess(std::string_view toml);

}  // namespace mrroc
