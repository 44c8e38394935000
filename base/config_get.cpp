// Typed access to a Config: defaults, types and ranges.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/config_store.hpp"
#include "base/joined.hpp"

namespace mrroc {
namespace {

/// The bounds in words; an open side is left out.
template <class B>
std::string range_text(const B& bounds) {
  const B all;
  if (bounds.min == bounds.max) return fmt::format("only {}", bounds.min);
  if (bounds.min > all.min && bounds.max < all.max) return fmt::format("{} to {}", bounds.min, bounds.max);
  if (bounds.min > all.min) return fmt::format("at least {}", bounds.min);
  if (bounds.max < all.max) return fmt::format("at most {}", bounds.max);
  return "";
}

/// Numbers given without a fraction, and empty lists, are of the type that is asked for.
template <class T>
void adapt(ConfigValue& value) {
  if constexpr (std::is_same_v<T, double>)
    if (const auto* whole = std::get_if<std::int64_t>(&value)) value = static_cast<double>(*whole);
  if constexpr (std::is_same_v<T, std::vector<std::string>>)
    if (const auto* list = std::get_if<std::vector<double>>(&value); list != nullptr && list->empty())
      value = std::vector<std::string>();
}

/// The value as an error shows it.
std::string shown(const ConfigValue& value) {
  constexpr std::size_t kMost = 80;
  std::string text = to_toml(value);
  if (text.size() > kMost) text = text.substr(0, kMost) + "..";
  return text;
}

/// @return the end of an error about a lone number or text where a list is wanted
template <class T>
std::string bracket_hint(const ConfigValue& value) {
  const bool number = std::holds_alternative<double>(value) || std::holds_alternative<std::int64_t>(value);
  const bool wanted =
      (std::is_same_v<T, std::vector<double>> && number) ||
      (std::is_same_v<T, std::vector<std::string>> && std::holds_alternative<std::string>(value));
  return wanted ? fmt::format("; a list stands in brackets: [{}]", shown(value)) : "";
}

bool finite(std::int64_t) { return true; }
bool finite(double value) { return std::isfinite(value); }

}  // namespace

std::string limits_text(std::string_view range, std::string_view unit) {
  return fmt::format("{}{}{}", range, range.empty() || unit.empty() ? "" : " ", unit);
}

/// A getter's expectation of a value.
struct Config::Asked {
  std::string type;   ///< in words, for messages
  std::string range;  ///< in words, may be empty
  Meaning meaning{};  ///< all of it may be empty

  /// @return range and unit
  [[nodiscard]] std::string limits() const { return limits_text(range, meaning.unit); }
  [[nodiscard]] std::string words() const { return limits().empty() ? type : type + ", " + limits(); }
};

template <class T>
T Config::take(std::string_view key, const std::optional<T>& fallback, const Asked& asked) const {
  const std::string path = fmt::format("{}{}", prefix_, key);
  store_->asked.insert(path);
  if (!store_->entries.contains(path)) {
    if (!fallback)
      throw ConfigError({store_->main_file.empty() ? "configuration" : store_->main_file}, path,
                        fmt::format("the key '{}' is missing, it must be {}", path, asked.words()));
    store_->put(path, {.value = *fallback, .place = {"default"}, .from_default = true});
  }
  ConfigEntry& entry = store_->entries.find(path)->second;
  adapt<T>(entry.value);
  const T* value = std::get_if<T>(&entry.value);
  if (value == nullptr)
    throw ConfigError(entry.place, path,
                      fmt::format("'{}' must be {}, and it is {}{}", path, asked.words(), shown(entry.value),
                                  bracket_hint<T>(entry.value)));
  if (entry.from_default && fallback && *value != *fallback)
    throw FaultError(FaultCode::internal_error, fmt::format("the key '{}' has two defaults", path));
  entry.range = asked.range;
  entry.unit = asked.meaning.unit;
  if (!asked.meaning.about.empty()) entry.about = asked.meaning.about;
  if (!asked.meaning.believed.empty()) entry.believed = asked.meaning.believed;
  return *value;
}

template <class T, class B>
void Config::check(std::string_view key, T value, B bounds, const Asked& asked) const {
  if (finite(value) && value >= bounds.min && value <= bounds.max) return;
  const std::string path = fmt::format("{}{}", prefix_, key);
  const ConfigPlace& place = store_->entries.find(path)->second.place;
  if (!finite(value)) throw ConfigError(place, path, fmt::format("'{}' is not a finite number", path));
  throw ConfigError(place, path,
                    fmt::format("'{}' is {}, out of its range: {}", path, shown(value), asked.limits()));
}

double Config::number(std::string_view key, std::optional<double> fallback, Bounds bounds,
                      const Meaning& meaning) const {
  const Asked asked{"a number", range_text(bounds), meaning};
  const auto value = take<double>(key, fallback, asked);
  check(key, value, bounds, asked);
  return value;
}

std::vector<double> Config::list(std::string_view key, const std::optional<std::vector<double>>& fallback,
                                 Bounds bounds, const Meaning& meaning,
                                 std::optional<std::size_t> size) const {
  const Asked asked{size ? fmt::format("a list of {} numbers", *size) : "a list of numbers",
                    range_text(bounds), meaning};
  auto value = take<std::vector<double>>(key, fallback, asked);
  for (const double element : value) check(key, element, bounds, asked);
  if (size && *size != value.size()) {
    const std::string path = fmt::format("{}{}", prefix_, key);
    throw ConfigError(store_->entries.find(path)->second.place, path,
                      fmt::format("'{}' must be {}, and it has {}", path, asked.type, value.size()));
  }
  return value;
}

std::int64_t Config::whole(std::string_view key, std::optional<std::int64_t> fallback, IntegerBounds bounds,
                           IntegerBounds in_type, const Meaning& meaning) const {
  const Asked asked{"a whole number", range_text(bounds), meaning};
  const auto value = take<std::int64_t>(key, fallback, asked);
  check(key, value, bounds, asked);
  check(key, value, in_type, {asked.type, range_text(in_type), meaning});
  return value;
}

bool Config::flag(std::string_view key, std::optional<bool> fallback, const Meaning& meaning) const {
  return take<bool>(key, fallback, {"true or false", "", meaning});
}

std::string Config::text(std::string_view key, const std::optional<std::string>& fallback) const {
  return take<std::string>(key, fallback, {"a text in quotation marks", ""});
}

std::vector<std::string> Config::texts(std::string_view key,
                                       const std::optional<std::vector<std::string>>& fallback) const {
  return take<std::vector<std::string>>(key, fallback, {"a list of texts", ""});
}

std::size_t Config::one_of(std::string_view key, const std::string& fallback,
                           const std::vector<std::string>& legal, const Meaning& meaning) const {
  const Asked asked{"a text", joined(legal, " or "), meaning};
  const auto value = take<std::string>(key, fallback, asked);
  const auto found = std::find(legal.begin(), legal.end(), value);
  if (found != legal.end()) return static_cast<std::size_t>(found - legal.begin());
  const std::string path = fmt::format("{}{}", prefix_, key);
  const std::string near = closest_match(value, WordSet(legal.begin(), legal.end()));
  throw ConfigError(store_->entries.find(path)->second.place, path,
                    fmt::format("'{}' is {}, it must be {}{}", path, shown(value), asked.range,
                                near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near)));
}

}  // namespace mrroc
