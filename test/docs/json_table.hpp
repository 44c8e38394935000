// The table in docs/interfaces.md that says which keys the commands of ui_cli print with --json.
#pragma once
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "base/file_content.hpp"

namespace mrroc::test {

/// @return words in code marks that are keys
inline std::set<std::string> keys_in(const std::string& text) {
  static const std::regex key(R"(`([A-Za-z_][\w.]*)`)");
  std::set<std::string> keys;
  for (auto m = std::sregex_iterator(text.begin(), text.end(), key); m != std::sregex_iterator(); ++m)
    keys.insert((*m)[1]);
  return keys;
}

/// @return keys of all objects in the document
/// @param data  keys of objects whose own keys are no words of a command: names of figures, ...
inline std::set<std::string> keys_of(const nlohmann::json& document, const std::set<std::string>& data) {
  std::set<std::string> keys;
  for (const auto& [key, value] : document.items()) {
    if (document.is_object()) keys.insert(key);
    if (value.is_structured() && !data.contains(document.is_object() ? key : ""))
      keys.merge(keys_of(value, data));
  }
  return keys;
}

/// @return whether a cell of the first column is this command, or a list in which it is
inline bool names(const std::string& cell, const std::string& command) {
  const std::string plain = std::regex_replace(cell, std::regex("`"), "");
  return plain == command || (", " + plain + ", ").find(", " + command + ", ") != std::string::npos;
}

/// @param command   as in the first column of the table, without code marks
/// @param document  what it has printed, with everything that it can tell
/// @return whether the table names the document's keys and no others
inline ::testing::AssertionResult documented(const std::string& command, const nlohmann::json& document,
                                             const std::set<std::string>& data = {}) {
  std::istringstream in(file_content(MRROC_SOURCE_DIR "/docs/interfaces.md"));
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("## ")) inside = line == "## JSON of the commands";
    const std::size_t second = line.find(" | ");
    if (!inside || second == std::string::npos || !names(line.substr(2, second - 2), command)) continue;
    const auto told = keys_in(line.substr(second)), printed = keys_of(document, data);
    if (told == printed) return ::testing::AssertionSuccess();
    auto result = ::testing::AssertionFailure() << "docs/interfaces.md, `" << command << "`:";
    for (const std::string& key : printed)
      if (!told.contains(key)) result << " lacks " << key << ";";
    for (const std::string& key : told)
      if (!printed.contains(key)) result << " has " << key << ", which is not printed;";
    return result;
  }
  return ::testing::AssertionFailure() << "docs/interfaces.md does not tell the keys of `" << command << "`";
}

}  // namespace mrroc::test
