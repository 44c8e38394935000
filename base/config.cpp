#include "base/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "base/config_bounds.hpp"
#include "base/config_store.hpp"
#include "base/joined.hpp"
#include "base/text_file.hpp"

namespace mrroc {
namespace {

std::string located(const ConfigPlace& place, const std::string& text) {
  std::string result = place.file;
  if (place.line > 0) result += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) result += fmt::format(":{}", place.column);
  return result + ": " + text;
}

/// What is to be corrected; empty: as for every wrong configuration.
std::string remedy_of(const ConfigPlace& place) {
  if (place.file.starts_with("--set ")) return "correct that --set option";
  if (place.file.starts_with("--")) return "correct that option";
  return place.line > 0 ? "correct that file" : "";
}

constexpr std::size_t kMostShown = 16;  // keys in an error

std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }

/// @return of the known keys that end with the part the one with the fewest parts, the first of equals; empty: none does
std::string least_deep(std::string_view part, const WordSet& known) {
  const auto depth = [](const std::string& k) { return std::count(k.begin(), k.end(), '.'); };
  std::string best;
  for (const std::string& k : known)
    if (last_part(k) == part && (best.empty() || depth(k) < depth(best))) best = k;
  return best;
}

/// The known key that was probably meant, as the end of a sentence.
std::string suggestion(std::string_view key, const WordSet& known) {
  if (const std::string near = closest_match(key, known); !near.empty())
    return fmt::format(", did you mean '{}'?", near);
  if (const std::string same = least_deep(last_part(key), known); !same.empty())
    return fmt::format(", did you mean '{}'?", same);
  const std::string_view table = key.substr(0, key.size() - last_part(key).size());
  std::vector<std::string> siblings;
  for (const std::string& k : known)
    if (k.starts_with(table) && k.find('.', table.size()) == std::string::npos)
      siblings.push_back(k.substr(table.size()));
  if (siblings.empty()) {
    WordSet sections;
    for (const std::string& k : known) sections.insert(k.substr(0, k.find('.')));
    return sections.empty() ? ""
                            : fmt::format(", nothing is known there; there are {}", joined(sections, ", "));
  }
  const std::size_t shown = std::min(siblings.size(), kMostShown);
  return fmt::format(", known keys there: {}{}", joined(std::span(siblings).first(shown), ", "),
                     shown < siblings.size() ? ", ..." : "");
}

}  // namespace

ConfigError::ConfigError(ConfigPlace place, std::string key, const std::string& text)
    : FaultError(FaultCode::bad_configuration, located(place, text), remedy_of(place)),
      place_(std::move(place)),
      key_(std::move(key)) {}

void ConfigStore::put(const std::string& key, ConfigEntry entry) {
  for (std::size_t dot = key.find('.'); dot != std::string::npos; dot = key.find('.', dot + 1))
    if (const auto above = entries.find(key.substr(0, dot)); above != entries.end())
      throw ConfigError(
          above->second.place, above->first,
          fmt::format("'{}' takes no value, it has keys of its own, such as '{}'", above->first, key));
  if (const auto below = entries.lower_bound(key + ".");
      entry.from_default && below != entries.end() && below->first.starts_with(key + "."))
    throw ConfigError(below->second.place, below->first,
                      fmt::format("'{}' is a value, it has no key '{}'", key, below->first));
  if (tables.contains(key) || !is_empty(key))
    throw ConfigError(entry.place, key, fmt::format("'{}' is a table and cannot have a value", key));
  entries.insert_or_assign(key, std::move(entry));
}

void ConfigStore::put_table(const std::string& name, const ConfigPlace& place) {
  if (entries.contains(name))
    throw ConfigError(place, name, fmt::format("'{}' is a value and cannot be a table", name));
  tables.emplace(name, place);
}

bool ConfigStore::is_empty(const std::string& table) const {
  const auto key = entries.lower_bound(table + ".");
  return key == entries.end() || !key->first.starts_with(table + ".");
}

bool ConfigStore::is_known(const std::string& table) const {
  const auto key = asked.lower_bound(table + ".");
  return asked.contains(table) || (key != asked.end() && key->starts_with(table + "."));
}

Config::Config() : store_(std::make_shared<ConfigStore>()) {}

Config Config::parse(std::string_view text, const std::string& name) {
  Config config;
  config.store_->main_file = name;
  config.store_->read(text, name, true);
  return config;
}

Config Config::load(const std::filesystem::path& file) {
  return parse(read_input_file(file, kLargestConfig, FaultCode::bad_configuration), file.string());
}

void Config::overlay(const Config& above) {
  for (const auto& [name, place] : above.store_->tables) store_->put_table(name, place);
  for (const auto& [key, entry] : above.store_->entries) store_->put(key, entry);
  if (store_->main_file.empty()) store_->main_file = above.store_->main_file;
}

void Config::underlay(const Config& below) {
  for (const auto& [name, place] : below.store_->tables)
    if (!store_->tables.contains(name)) store_->put_table(name, place);
  for (const auto& [key, entry] : below.store_->entries)
    if (!store_->entries.contains(key)) store_->put(key, entry);
}

void Config::set(const std::string& assignment) {
  const std::string name = "--set " + assignment;
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0)
    throw ConfigError({name}, {}, "a value is set as key=value");
  const std::string value = assignment.substr(equals + 1);
  const bool word = !value.empty() && std::all_of(value.begin(), value.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_-./:").find(static_cast<char>(c)) != std::string::npos;
  });
  Config one;
  try {
    one.store_->read(assignment, name, false);
  } catch (const ConfigError&) {
    if (!word) throw;
    one.store_->read(assignment.substr(0, equals + 1) + '"' + value + '"', name, false);
  }
  overlay(one);
}

Config Config::section(std::string_view table) const {
  Config result = *this;
  result.prefix_ = fmt::format("{}{}.", prefix_, table);
  return result;
}

std::vector<std::string> Config::tables(std::string_view table) const {
  const std::string beginning = table.empty() ? prefix_ : fmt::format("{}{}.", prefix_, table);
  std::vector<std::string> names;
  for (const auto& [name, place] : store_->tables)
    if (name.starts_with(beginning) && name.find('.', beginning.size()) == std::string::npos) {
      names.push_back(name.substr(beginning.size()));
      store_->asked.insert(name);
    }
  return names;
}

bool Config::has(std::string_view key) const {
  return store_->entries.contains(fmt::format("{}{}", prefix_, key));
}

Config Config::copy() const {
  Config other = *this;
  other.store_ = std::make_shared<ConfigStore>(*store_);
  return other;
}

void Config::check_all_used() const {
  std::string unknown;
  ConfigPlace where;
  int count = 0;
  const auto note = [&](const std::string& key, const ConfigPlace& place) {
    if (count++ > 0 && std::tie(where.file, where.line) <= std::tie(place.file, place.line)) return;
    unknown = key;
    where = place;
  };
  for (const auto& [key, entry] : store_->entries)
    if (key.starts_with(prefix_) && !store_->asked.contains(key)) note(key, entry.place);
  for (const auto& [name, place] : store_->tables)
    if (name.starts_with(prefix_) && store_->is_empty(name) && !store_->is_known(name)) note(name, place);
  if (count == 0) return;
  const std::string others =
      count > 1 ? fmt::format(" ({} more {} unknown)", count - 1, count > 2 ? "are" : "is") : "";
  throw ConfigError(where, unknown,
                    fmt::format("unknown key '{}'{}{}", unknown, suggestion(unknown, store_->asked), others));
}

std::vector<ConfigParameter> Config::parameters() const {
  std::vector<ConfigParameter> all;
  for (const auto& [key, entry] : store_->entries)
    if (store_->asked.contains(key))
      all.push_back({key, to_toml(entry.value), entry.range, entry.unit, entry.about, entry.believed});
  return all;
}

std::string Config::dump() const { return store_->write(); }

}  // namespace mrroc
