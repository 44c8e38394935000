// Converts between TOML and the flat map of a Config. The only file that uses the TOML library.
#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cctype>
#include <optional>

#include "base/config_bounds.hpp"
#include "base/config_store.hpp"
#include "base/joined.hpp"

namespace mrroc {
namespace {

bool is_bare(std::string_view key) {
  return !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

struct Reader {
  ConfigStore& store;
  std::string name;
  bool with_lines;

  [[nodiscard]] ConfigPlace place(const toml::source_region& source) const {
    return {name, with_lines ? static_cast<int>(source.begin.line) : 0, 0};
  }

  void table(const toml::table& content, const std::string& prefix) {
    for (const auto& [key, node] : content) {
      const std::string path = prefix + std::string(key.str());
      if (path.size() > kLongestKey)
        throw ConfigError(place(node.source()), path.substr(0, kLongestKey),
                          fmt::format("a key with {} characters; it may have {}", path.size(), kLongestKey));
      if (!is_bare(key.str()))
        throw ConfigError(place(node.source()), path, "a key may have letters, digits, '_' and '-' only");
      if (std::ranges::count(path, '.') >= kMostKeyParts)  // with those of the tables around it
        throw ConfigError(place(node.source()), {}, fmt::format("a key has over {} parts", kMostKeyParts));
      if (const auto* inner = node.as_table()) {
        store.put_table(path, place(node.source()));
        table(*inner, path + ".");
      } else {
        store.put(path, {.value = value(node, path), .place = place(node.source())});
      }
    }
  }

  [[nodiscard]] ConfigValue value(const toml::node& node, const std::string& path) const {
    if (const auto* v = node.as_boolean()) return v->get();
    if (const auto* v = node.as_integer()) return v->get();
    if (const auto* v = node.as_floating_point()) return v->get();
    if (const auto* v = node.as_string()) return v->get();
    if (const auto* v = node.as_array()) return list(*v, path);
    throw ConfigError(place(node.source()), path,
                      fmt::format("'{}' is a date or time, which have no use", path));
  }

  [[nodiscard]] double number(const toml::node& node, const std::string& path) const {
    if (const std::optional<double> exact = node.value<double>()) return *exact;
    throw ConfigError(place(node.source()), path,
                      fmt::format("'{}' has an integer that is too large for a list of numbers", path));
  }

  [[nodiscard]] ConfigValue list(const toml::array& array, const std::string& path) const {
    std::vector<double> numbers;
    std::vector<std::string> texts;
    for (const toml::node& node : array) {
      if (node.is_number()) numbers.push_back(number(node, path));
      if (const auto* v = node.as_string()) texts.push_back(v->get());
    }
    if (numbers.size() == array.size()) return numbers;
    if (texts.size() == array.size()) return texts;
    const bool nested =
        std::any_of(array.begin(), array.end(), [](const toml::node& node) { return node.is_array(); });
    throw ConfigError(place(array.source()), path,
                      fmt::format("'{}' must be a list of numbers or a list of texts{}", path,
                                  nested ? ", without lists in it: all numbers one after another" : ""));
  }
};

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\')
      result += {'\\', c};
    else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      result += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    else
      result += c;
  }
  return result + '"';
}

struct Writer {
  std::string operator()(bool v) const { return v ? "true" : "false"; }
  std::string operator()(std::int64_t v) const { return std::to_string(v); }
  std::string operator()(double v) const {
    const std::string digits = fmt::format("{}", v);  // the shortest that reads back as the same number
    return digits.find_first_of(".enif") == std::string::npos ? digits + ".0" : digits;
  }
  std::string operator()(const std::string& v) const { return quoted(v); }
  template <class T>
  std::string operator()(const std::vector<T>& list) const {
    std::vector<std::string> parts;
    for (const T& v : list) parts.push_back((*this)(v));
    return fmt::format("[{}]", joined(parts, ", "));
  }
};

}  // namespace

std::string to_toml(const ConfigValue& value) { return std::visit(Writer{}, value); }

void ConfigStore::read(std::string_view text, const std::string& name, bool with_lines) {
  if (text.size() > kLargestConfig)
    throw ConfigError({name}, {},
                      fmt::format("{} bytes are over the limit of {}", text.size(), kLargestConfig));
  if (const auto excess = config_excess(text))
    throw ConfigError({name, with_lines ? excess->line : 0, excess->column}, {}, excess->wrong);
  try {
    Reader{*this, name, with_lines}.table(toml::parse(text, name), "");
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw ConfigError({name, with_lines ? static_cast<int>(at.line) : 0, static_cast<int>(at.column)}, {},
                      std::string(error.description()));
  }
}

std::string ConfigStore::write() const {
  struct Line {
    std::string text;
    std::string note;
  };
  std::map<std::string, std::vector<Line>> groups;
  for (const auto& [name, place] : tables)
    if (is_empty(name)) groups[name];
  for (const auto& [key, entry] : entries) {
    const std::size_t dot = key.rfind('.');
    const std::string table = dot == std::string::npos ? "" : key.substr(0, dot);
    const std::string name = dot == std::string::npos ? key : key.substr(dot + 1);
    groups[table].push_back({name + " = " + to_toml(entry.value), limits_text(entry.range, entry.unit)});
  }
  std::string result;
  for (const auto& [table, lines] : groups) {
    if (!table.empty()) result += fmt::format("{}[{}]\n", result.empty() ? "" : "\n", table);
    constexpr std::size_t kLong = 40;  // such a line does not push the notes of the others aside
    std::size_t width = 0;
    for (const Line& line : lines)
      if (line.text.size() <= kLong) width = std::max(width, line.text.size());
    for (const Line& line : lines)
      result +=
          line.note.empty() ? line.text + "\n" : fmt::format("{:{}}  # {}\n", line.text, width, line.note);
  }
  return result;
}

}  // namespace mrroc
