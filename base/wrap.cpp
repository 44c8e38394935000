#include "base/wrap.hpp"

#include <algorithm>

namespace mrroc {

std::string cut(const std::string& text, int room) {
  constexpr int kLeast = 8;
  if (static_cast<int>(text.size()) <= room) return text;
  if (room <= kLeast) return "";
  const auto most = static_cast<std::size_t>(room - 2);
  std::size_t end = text[most] == ' ' ? most : text.find_last_of(' ', most);
  if (end == std::string::npos || end < kLeast) end = most;  // one long word
  return text.substr(0, text.find_last_not_of(" :;,", end - 1) + 1) + "..";
}

std::vector<std::string> wrap(std::string_view text, int width) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    bool quoted = false;
    std::size_t end = 0;
    while (end < text.size() && (quoted || text[end] != ' ')) quoted ^= text[end++] == '`';
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(text.size(), end + 1));
    const bool fits = !lines.empty() && static_cast<int>(lines.back().size() + 1 + word.size()) <= width;
    if (fits)
      lines.back().append(" ").append(word);
    else if (!word.empty())
      lines.emplace_back(word);
  }
  return lines;
}

}  // namespace mrroc
