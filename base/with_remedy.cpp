#include "base/with_remedy.hpp"

#include <fmt/core.h>

#include <cctype>

namespace mrroc {

std::string with_remedy(const std::string& what, std::string_view remedy) {
  if (!what.ends_with('?') || remedy.empty()) return fmt::format("{}; {}", what, remedy);
  std::string next(remedy);
  next.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(next.front())));
  return what + " " + next;
}

}  // namespace mrroc
