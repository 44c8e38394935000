#include "base/command_words.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <span>

#include "base/command_hint.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"

namespace mrroc {

bool asks_for_help(const std::vector<std::string>& words) {
  const auto end = std::ranges::find(words, "--");
  return std::find_if(words.begin(), end, [](const auto& w) { return w == "-h" || w == "--help"; }) != end;
}

std::string explained(ExplainedLines lines) {
  std::size_t width = 0;
  for (auto& entry : lines) {
    entry.first = typed(entry.first);
    width = std::max(width, entry.first.size());
  }
  std::string text;
  for (const auto& [line, does] : lines)
    text += does.empty() ? fmt::format("  {}\n", line) : fmt::format("  {:<{}}   {}\n", line, width, does);
  return text;
}

FaultError no_such_word(const std::string& kind, const std::string& word, const std::string& near) {
  return {FaultCode::bad_usage, fmt::format("there is no {} '{}'{}", kind, word,
                                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near))};
}

bool is_setting(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals > 0 && word.front() != '-';
}

std::string what_to_type(const Examples& examples, const std::string& command, const std::string& word) {
  const auto find = [&](const std::string& begin) {
    return std::ranges::find_if(examples, [&](const std::string& line) {
      return line.starts_with(begin) && fmt::format("{} ", line).find(word) != std::string::npos;
    });
  };
  auto found = find(command);
  if (found == examples.end() && !word.empty()) found = find("");
  if (found != examples.end()) return fmt::format("type for example `{}`", *found);
  return command.empty() ? "look at --help" : fmt::format("look at `{} --help`", command);
}

std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  const std::string before = joined(std::span(names).first(names.size() - 1), ", ");
  return before.empty() ? names.back() : fmt::format("{} and {}", before, names.back());
}

}  // namespace mrroc
