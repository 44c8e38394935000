// Configuration from TOML files and --set options. One line per parameter, which is also its documentation:
//
//   auto cfg = Config::load("tasks/drawing/drawing.toml");
//   cfg.set("sim.paper.stiffness=2e4");
//   p.stiffness = cfg.number("sim.paper.stiffness", 1e4, {100, 1e6}, "N/m");
//   p.clock = cfg.choice("clock", Clock::step, {{"step", Clock::step}, {"wall", Clock::wall}});
//   p.weight = cfg.number("robots.arm1.tool.weight", Config::kRequired, {0, 100}, "N");
//   cfg.check_all_used();
//   write("config.toml", cfg.dump());
//
// Every parameter is read at start by one process, the parent; its dump is what the other processes load.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/fault.hpp"

namespace mrroc {

/// The place from which a value of the configuration comes.
struct ConfigPlace {
  std::string file;  ///< path as given, "--set KEY=VALUE", or "default"
  int line{};        ///< counted from 1; 0: not in a file
  int column{};      ///< counted from 1; 0: the whole line is meant
};

/// Anything wrong with a configuration; its code is bad_configuration. what() begins with "file:line:column:
/// ".
class ConfigError : public FaultError {
 public:
  /// @param key  dotted, empty: the file as a whole is meant  @param text  what is wrong and what is right
  ConfigError(ConfigPlace place, std::string key, const std::string& text);

  /// @return where it stands
  [[nodiscard]] const ConfigPlace& place() const noexcept { return place_; }
  /// @return the dotted key that the error is about; empty when it is about the file
  [[nodiscard]] const std::string& key() const noexcept { return key_; }

 private:
  ConfigPlace place_;
  std::string key_;
};

/// Closed interval of legal numbers.
struct Bounds {
  /// Smallest legal number; default: none is too small.
  double min{-std::numeric_limits<double>::infinity()};
  double max{std::numeric_limits<double>::infinity()};  ///< largest legal number; default: none is too large
};

/// Closed interval of legal integers.
struct IntegerBounds {
  std::int64_t min{std::numeric_limits<std::int64_t>::min()};  ///< smallest legal integer
  std::int64_t max{std::numeric_limits<std::int64_t>::max()};  ///< largest legal integer
};

/// A key that the program reads, for lists.
struct ConfigParameter {
  std::string key{};       ///< dotted, from the root
  std::string value{};     ///< in TOML: given, or the default
  std::string range{};     ///< legal values in words; empty: any of its type
  std::string unit{};      ///< empty: it has none
  std::string about{};     ///< as Meaning::about
  std::string believed{};  ///< as Meaning::believed
};

/// What a value is, for messages, dump() and lists. A unit alone converts to it.
struct Meaning {
  std::string_view unit{};   ///< of the value and its bounds; empty: it has none
  std::string_view about{};  ///< in words; empty: the key says it
  /// Of a value that is true of the plant: where stands what controllers believe of it, a key or words; empty: of none.
  std::string_view believed{};

  Meaning() = default;
  Meaning(const char* u) : unit(u) {}         // NOLINT(google-explicit-constructor)
  Meaning(std::string_view u) : unit(u) {}    // NOLINT(google-explicit-constructor)
  Meaning(const std::string& u) : unit(u) {}  // NOLINT(google-explicit-constructor)
  /// @param u  unit @param a  about @param b  believed
  Meaning(std::string_view u, std::string_view a, std::string_view b = {}) : unit(u), about(a), believed(b) {}
};

struct ConfigStore;

/// A tree of values under dotted keys, e.g. "robots.arm1.tool.weight". A handle: copies and sections share
/// the values and the memory of which keys were read. For use by one thread; every function allocates and may
/// throw ConfigError, so none belongs into the servo step.
class Config {
 public:
  /// Stands for "no default": the key must be in a file or a --set option.
  static constexpr std::nullopt_t kRequired = std::nullopt;

  /// An empty configuration: every parameter has its default.
  Config();

  /// @throws FaultError bad_configuration: no such file, no file but a folder, a pipe or the like, or one that cannot be
  ///         read
  /// @throws ConfigError a syntax error with its line and column; too large or too deep (base/config_bounds.hpp)
  static Config load(const std::filesystem::path& file);
  /// @param text TOML: tables, numbers, truth values, texts, lists of numbers or of texts
  /// @param name what errors call the text
  static Config parse(std::string_view text, const std::string& name);

  /// Puts the values of another configuration over those here. To be done before any value is read.
  /// @throws ConfigError a value where the other one has a table
  void overlay(const Config& above);
  /// Gives values of another configuration to keys that have none here. To be done before any of them is read.
  /// @throws ConfigError a value where the other one has a table
  void underlay(const Config& below);
  /// Overrides one value. To be done before it is read.
  /// @param assignment `key=value` with a dotted key from the root and a value in TOML; a single word needs
  /// no
  ///        quotation marks
  void set(const std::string& assignment);

  /// The part of the configuration below a table; keys given to it are relative to the table.
  [[nodiscard]] Config section(std::string_view table) const;
  /// @return names of the tables directly below the table in alphabetical order, e.g. the robots' names
  [[nodiscard]] std::vector<std::string> tables(std::string_view table) const;
  /// @return whether the key has a value by now
  [[nodiscard]] bool has(std::string_view key) const;

  // Each of the following returns the value of the key, or the fallback if it has none; dump() then contains
  // it. The fallback must be the same wherever a key is read. ConfigError: missing and required, another
  // type, not finite, or out of bounds.

  /// @param meaning at least the unit of the value and the bounds
  [[nodiscard]] double number(std::string_view key, std::optional<double> fallback, Bounds bounds = {},
                              const Meaning& meaning = {}) const;
  /// @return a list of exactly N numbers, each within the bounds: `cfg.numbers<3>("up", {{0, 0, 1}})`
  template <std::size_t N>
  [[nodiscard]] std::array<double, N> numbers(std::string_view key,
                                              const std::optional<std::array<double, N>>& fallback,
                                              Bounds bounds = {}, const Meaning& meaning = {}) const {
    std::optional<std::vector<double>> given;
    if (fallback) given.emplace(fallback->begin(), fallback->end());
    given = list(key, given, bounds, meaning, N);
    std::array<double, N> result{};
    std::copy_n(given->begin(), N, result.begin());
    return result;
  }
  /// @param size number of elements that the list must have, if not any number
  [[nodiscard]] std::vector<double> list(std::string_view key,
                                         const std::optional<std::vector<double>>& fallback,
                                         Bounds bounds = {}, const Meaning& meaning = {},
                                         std::optional<std::size_t> size = {}) const;
  /// @return a whole number, of any integer type
  template <class T = int>
  [[nodiscard]] T integer(std::string_view key, std::type_identity_t<std::optional<T>> fallback,
                          IntegerBounds bounds = {}, const Meaning& meaning = {}) const {
    static_assert(std::is_integral_v<T> && !std::is_same_v<T, bool>);
    std::optional<std::int64_t> wide;
    if (fallback) wide = static_cast<std::int64_t>(*fallback);
    return static_cast<T>(whole(key, wide, bounds, within<T>(bounds), meaning));
  }
  /// @return true or false
  [[nodiscard]] bool flag(std::string_view key, std::optional<bool> fallback,
                          const Meaning& meaning = {}) const;
  /// @return any text, also an empty one
  [[nodiscard]] std::string text(std::string_view key, const std::optional<std::string>& fallback) const;
  /// @return a list of texts of any length
  [[nodiscard]] std::vector<std::string> texts(std::string_view key,
                                               const std::optional<std::vector<std::string>>& fallback) const;
  /// @param names the legal texts and what they stand for
  template <class T>
  [[nodiscard]] T choice(std::string_view key, T fallback,
                         std::type_identity_t<std::initializer_list<std::pair<std::string_view, T>>> names,
                         const Meaning& meaning = {}) const {
    return choice(key, fallback, std::span<const std::pair<std::string_view, T>>(names), meaning);
  }
  /// The same, of names that are not known when the program is compiled.
  template <class T>
  [[nodiscard]] T choice(std::string_view key, T fallback,
                         std::type_identity_t<std::span<const std::pair<std::string_view, T>>> names,
                         const Meaning& meaning = {}) const {
    std::vector<std::string> legal;
    std::string name;
    for (const auto& [word, value] : names) {
      legal.emplace_back(word);
      if (value == fallback) name = word;
    }
    return names[one_of(key, name, legal, meaning)].second;
  }

  /// Call this when everything has been read.
  /// @throws ConfigError a key in this section that nothing asked for: file, line, key and the nearest known
  /// key
  void check_all_used() const;
  /// @return all values from the root, given and default, as TOML with units and ranges as comments; parsing
  ///         it gives the same values
  [[nodiscard]] std::string dump() const;

  /// @return every key that was asked for, in alphabetical order
  [[nodiscard]] std::vector<ConfigParameter> parameters() const;

  /// @return the same configuration with a memory of its own of what is asked for: another thread may read it
  [[nodiscard]] Config copy() const;

 private:
  struct Asked;
  template <class T>
  static constexpr IntegerBounds within(IntegerBounds b) {
    using Limits = std::numeric_limits<T>;
    if (std::cmp_less(b.min, Limits::min())) b.min = static_cast<std::int64_t>(Limits::min());
    if (std::cmp_greater(b.max, Limits::max())) b.max = static_cast<std::int64_t>(Limits::max());
    return b;
  }
  [[nodiscard]] std::int64_t whole(std::string_view key, std::optional<std::int64_t> fallback,
                                   IntegerBounds bounds, IntegerBounds in_type, const Meaning& meaning) const;
  [[nodiscard]] std::size_t one_of(std::string_view key, const std::string& fallback,
                                   const std::vector<std::string>& legal, const Meaning& meaning) const;
  template <class T>
  [[nodiscard]] T take(std::string_view key, const std::optional<T>& fallback, const Asked& asked) const;
  template <class T, class B>
  void check(std::string_view key, T value, B bounds, const Asked& asked) const;

  std::shared_ptr<ConfigStore> store_;
  std::string prefix_;  // empty, or a table's name and a dot
};

}  // namespace mrroc
