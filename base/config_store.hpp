// The values of a Config and their places; used by the reader and writer of TOML and by the typed access.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/closest_match.hpp"
#include "base/config.hpp"

namespace mrroc {

/// Value of one key.
using ConfigValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One key's value and what is known about it.
struct ConfigEntry {
  ConfigValue value{};       ///< as it was given; its range is checked when it is read
  ConfigPlace place{};       ///< where it was given
  std::string range{};       ///< legal values in words, known once it was read; empty: any of its type
  std::string unit{};        ///< the same, as Meaning has it; so are the next two
  std::string about{};       ///< in words; empty: the key says it
  std::string believed{};    ///< of what is true of the plant: what controllers have instead
  bool from_default{false};  ///< nobody gave it: the code's default
};

/// All values in a flat map; a key with dots stands for the tables on the way to it.
struct ConfigStore {
  std::map<std::string, ConfigEntry, std::less<>> entries;  ///< by dotted key
  std::map<std::string, ConfigPlace, std::less<>> tables;   ///< tables that a file names, also empty ones
  WordSet asked;                                            ///< keys and tables that the program knows
  std::string main_file;                                    ///< for the message that a key is missing

  /// Adds or replaces a value. @throws ConfigError the key is a table, or leads through a value
  void put(const std::string& key, ConfigEntry entry);
  /// Notes a table. @throws ConfigError a value stands there
  void put_table(const std::string& name, const ConfigPlace& place);

  /// @return whether no key below the table has a value
  [[nodiscard]] bool is_empty(const std::string& table) const;
  /// @return whether the program has asked for the table or for a key below it
  [[nodiscard]] bool is_known(const std::string& table) const;

  /// Reads TOML. @throws ConfigError
  void read(std::string_view text, const std::string& name, bool with_lines);
  /// @return TOML
  [[nodiscard]] std::string write() const;
};

/// @return range and unit as one text: "0 to 5 N"; either may be empty
[[nodiscard]] std::string limits_text(std::string_view range, std::string_view unit);
/// @return the value as TOML
[[nodiscard]] std::string to_toml(const ConfigValue& value);

}  // namespace mrroc
