// What may be the key of a robot, a platform or a camera: it is part of names of channels, processes and files.
#pragma once
#include <algorithm>
#include <cctype>
#include <cstddef>
#include <string_view>

namespace mrroc {

/// Characters of a key, at most.
inline constexpr std::size_t kLongestKey = 16;

/// @return whether it has 1 to kLongestKey letters, digits, - and _ and nothing else
[[nodiscard]] inline bool is_key_word(std::string_view s) {
  return !s.empty() && s.size() <= kLongestKey &&
         std::ranges::all_of(s, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '_'; });
}

}  // namespace mrroc
