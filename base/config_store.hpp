// What a Config is made of, between the reader of TOML, the typed access and the writer of TOML.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/config.hpp"
#include "base/nearest.hpp"

namespace mrroc {

/// Value of one key.
using ConfigValue =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, std::vector<std::string>>;

/// One key's value and what is known about it.
struct ConfigEntry {
  ConfigValue value;         ///< as it was given; its range is checked when it is read
  ConfigPlace place;         ///< where it was given
  std::string note;          ///< unit and range, known once it was read
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

/// @return the value as TOML
[[nodiscard]] std::string to_toml(const ConfigValue& value);

}  // namespace mrroc
