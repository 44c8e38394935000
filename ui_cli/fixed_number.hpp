// A number with fixed decimals, for people.
#pragma once
#include <fmt/core.h>

#include <string>

namespace mrroc::ui {

/// @return the number with so many decimals; one that rounds to zero has no sign
[[nodiscard]] inline std::string fixed(double x, int decimals) {
  std::string text = fmt::format("{:.{}f}", x, decimals);
  if (text.starts_with('-') && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

}  // namespace mrroc::ui
