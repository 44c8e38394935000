// Reads the command lines of all programs, and reports words that do not exist or are missing.
#pragma once
#include <concepts>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "base/command_words.hpp"

namespace mrroc {

/// Says what is wrong with a value; the error of the line names the option before it.
class WrongValue : public std::invalid_argument {
 public:
  using std::invalid_argument::invalid_argument;
};

/// Takes or checks a value as it was typed. @throws WrongValue; other errors leave the parsing as they are
using TextFunction = std::function<void(const std::string& text)>;

/// A type that keeps the value of an option. A vector takes all words that follow; an optional is empty without the option.
template <class T>
concept OptionValue = std::same_as<T, std::string> || std::same_as<T, std::filesystem::path> ||
    std::same_as<T, int> || std::same_as<T, std::int64_t> || std::same_as<T, double> ||
    std::same_as<T, std::optional<std::string>> || std::same_as<T, std::optional<double>> ||
    std::same_as<T, std::vector<std::string>> || std::same_as<T, std::vector<std::filesystem::path>>;

/// Value of one of several words: an enumeration that is kept in a byte.
template <class T>
concept ByteEnum = std::is_enum_v<T> && std::same_as<std::underlying_type_t<T>, std::uint8_t>;

/// An option, a flag or a place of a command line: a light handle, valid as long as the line. What it says of the option
/// is to be said before the line is parsed.
class Option {
 public:
  /// @param name  of its value in the help, such as FILE
  Option type_name(const std::string& name) const;
  /// @param text  for the help, instead of what it was made with
  Option about(const std::string& text) const;
  /// Its value at this time is named in the help.
  Option show_default() const;

  /// A line without it is wrong.
  Option required(bool is = true) const;
  /// It may stand without a value: then given() tells that it was there.
  Option value_optional() const;
  /// Of a vector: separates values within a word.
  Option delimiter(char between) const;

  /// Another value is refused, and the help names those that there are.
  Option one_of(const std::vector<std::string>& values) const;
  /// A value outside of it is refused, and the help names the limits.
  Option range(int low, int high) const;
  Option range(double low, double high) const;
  /// @param look  sees every value before it is used
  Option check(const TextFunction& look) const;

  /// A line with both is wrong.
  Option excludes(const Option& other) const;
  /// A line with this one and without the other is wrong.
  Option needs(const Option& other) const;

  /// @return whether the line that was parsed has it
  [[nodiscard]] bool given() const;

 private:
  friend class CommandLine;
  struct Held;
  explicit Option(Held& held) : held_(&held) {}
  Held* held_;
};

/// The command line of a program, or of a command within it. Options are added, then the line is parsed once.
///
/// A name of an option begins with --; without that it is a place: words that stand by themselves, in the order in which
/// places are added. Values must live until the line is parsed; they stay as they are when it does not give them.
class CommandLine {
 public:
  /// @param about  above the options in the help
  /// @param name   in help and errors; empty: that of the running program
  explicit CommandLine(const std::string& about = {}, const std::string& name = {});
  ~CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  /// @param about  for the help, here and below
  template <OptionValue Value>
  Option option(const std::string& name, Value& value, const std::string& about = {});
  /// @param take  gets the value
  Option option(const std::string& name, const TextFunction& take, const std::string& about);
  /// An option with a value that nobody wants.
  Option ignored_option(const std::string& name, const std::string& about);
  /// One of several words, each of which means a value.
  template <ByteEnum Value>
  Option choice(const std::string& name, Value& value, const std::map<std::string, Value>& meanings,
                const std::string& about) {
    std::map<std::string, std::uint8_t> numbers;
    for (const auto& [word, meaning] : meanings) numbers.emplace(word, static_cast<std::uint8_t>(meaning));
    return numbered(
        name, numbers, [&value](std::uint8_t number) { value = static_cast<Value>(number); }, about);
  }
  /// An option without a value. @param value  becomes true when it is given
  Option flag(const std::string& name, bool& value, const std::string& about);
  /// A flag that says what is so anyway.
  Option flag(const std::string& name, const std::string& about);
  /// @return an option that has been added. @throws std::out_of_range  there is none of this name
  [[nodiscard]] Option named(const std::string& name);

  /// Text at the end of the help; subcommands that are added later have the same.
  void footer(const std::string& text);

  /// Adds a command, which has a line of its own behind its name. @return valid as long as this one
  CommandLine& subcommand(const std::string& name, const std::string& about);
  /// Adds a subcommand that makes a machine do something: for a wrong word it is only suggested when hardly anything else
  /// can be meant.
  CommandLine& order(const std::string& name, const std::string& about);
  /// A line has one subcommand. @param required  false: or none
  void take_one_subcommand(bool required);
  /// Options of this line may also stand behind the subcommands that are added later.
  void take_options_anywhere();
  /// Of a subcommand: nothing behind its name is looked at; remaining() has it.
  void take_words_unread();
  /// @param what  is called when the words of a line have been parsed and name this subcommand
  void when_given(const std::function<void()>& what);
  /// @return words that were not parsed
  [[nodiscard]] std::vector<std::string> remaining() const;

  /// @return as help and errors show it
  [[nodiscard]] std::string name() const;
  /// @return text above the options in the help
  [[nodiscard]] std::string about() const;
  /// @return the options as they are typed: "--help" and those that were added, in their order
  [[nodiscard]] std::vector<std::string> long_options() const;
  /// @return in the order in which they were added
  [[nodiscard]] std::vector<const CommandLine*> subcommands() const;

  /// Help does not wait for the rest of the line to be right.
  /// @return the help of the command that the words name, or of the whole line; nothing when they do not ask for it
  [[nodiscard]] std::optional<std::string> help_asked(const std::vector<std::string>& words) const;
  /// The same for the arguments of main().
  [[nodiscard]] std::optional<std::string> help_asked(int argc, const char* const* argv);

  /// Call this before parsing, where a required option that is missing would be told before one that does not
  /// exist.
  /// @throws FaultError bad_usage that names the first such option, and the nearest that exists
  void refuse_unknown_options(int argc, const char* const* argv) const;

  /// Takes the arguments of main() apart.
  /// @param examples  lines that the program understands
  /// @throws FaultError bad_usage: words that do not exist or are missing are named, with what to type
  void parse(int argc, const char* const* argv, const Examples& examples = {});
  /// The same for the words behind the name of a program or command. @throws FaultError bad_usage
  void parse(const std::vector<std::string>& words, const Examples& examples = {});
  /// The same where help waits for the options before it to be right.
  /// @return the help, when the line asks for it @throws FaultError bad_usage
  [[nodiscard]] std::optional<std::string> parse_or_help(int argc, const char* const* argv,
                                                         const Examples& examples = {});
  /// Takes apart the words behind the name of a command.
  /// @param out  gets the help that was asked for
  /// @param err  is told what is wrong
  /// @return exit status when there is nothing more to do
  [[nodiscard]] std::optional<int> parse_words(const std::vector<std::string>& words, std::ostream& out,
                                               std::ostream& err, const Examples& examples = {});

 private:
  struct Parts;
  explicit CommandLine(std::unique_ptr<Parts> parts);
  Option numbered(const std::string& name, const std::map<std::string, std::uint8_t>& numbers,
                  const std::function<void(std::uint8_t)>& take, const std::string& about);

  std::unique_ptr<Parts> parts_;
};

}  // namespace mrroc
