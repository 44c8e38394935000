// Prints text to the user at once.
#pragma once
#include <cstdio>
#include <string_view>
#include <tuple>

namespace mrroc {

/// Writes text to a stream at once. Nobody may be there to read it, as behind `| head -1`: that ends no motion, so that it
/// is no error.
inline void print(std::FILE* to, std::string_view text) noexcept {
  std::ignore = std::fwrite(text.data(), 1, text.size(), to);
  std::ignore = std::fflush(to);
}

}  // namespace mrroc
