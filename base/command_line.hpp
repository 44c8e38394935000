// What the command lines of all programs say of a word that does not exist, and of one that is missing.
#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "base/as_typed.hpp"
#include "base/fault.hpp"
#include "base/nearest.hpp"
#include "base/program.hpp"

namespace mrroc {

/// @param kind  "option" or "command"
/// @return bad_usage that names the word, and the nearest of those that exist
inline FaultError unknown_word(const std::string& kind, const std::string& word, const WordSet& known) {
  const std::string near = nearest(word, known);
  return {FaultCode::bad_usage, fmt::format("there is no {} '{}'{}", kind, word,
                                            near.empty() ? "" : fmt::format("; did you mean '{}'?", near))};
}

/// Adds the long options of a command line, as they are written.
inline void add_options(const CLI::App& app, WordSet& known) {
  for (const CLI::Option* o : app.get_options())
    for (const std::string& name : o->get_lnames()) known.insert("--" + name);
}

/// To be called before parsing: CLI11 tells of a required option that is missing before one that does not exist.
/// @throws FaultError bad_usage that names the first such option, and the nearest that exists
inline void refuse_unknown_options(const CLI::App& app, int argc, const char* const* argv) {
  WordSet known;
  add_options(app, known);
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--") return;
    const std::string name = word.substr(0, word.find('='));
    if (name.starts_with("--") && !known.contains(name)) throw unknown_word("option", name, known);
  }
}

/// @return whether -h or --help is among the words before "--"
inline bool asks_for_help(const std::vector<std::string>& words) {
  const auto end = std::ranges::find(words, "--");
  return std::find_if(words.begin(), end, [](const auto& w) { return w == "-h" || w == "--help"; }) != end;
}

/// Help does not wait for the rest of the line to be right.
/// @return the help of the command that the words name, or of the whole line; nothing when they do not ask for it
inline std::optional<std::string> help_asked(const CLI::App& app, const std::vector<std::string>& words) {
  if (!asks_for_help(words)) return std::nullopt;
  const CLI::App* command = &app;
  std::string before;
  for (const std::string& word : words)
    for (const CLI::App* inner : command->get_subcommands(nullptr))
      if (inner->get_name() == word) {
        before += (before.empty() ? "" : " ") + command->get_name();
        command = inner;
        break;
      }
  return as_typed(command->help(before));
}

/// The same for the command line of a program, which gives the app its name if it has none.
inline std::optional<std::string> help_asked(CLI::App& app, int argc, const char* const* argv) {
  if (app.get_name().empty()) app.name(this_program().filename().string());
  return help_asked(app, std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}

/// @return bad_usage for words that no command of the line knows, better than what CLI11 says where that is possible
inline FaultError unknown_word(const CLI::App& app, const CLI::Error& e) {
  const std::vector<std::string> words = app.remaining(true);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    WordSet options;
    add_options(app, options);
    for (const CLI::App* command : app.get_subcommands()) add_options(*command, options);
    return unknown_word("option", word.substr(0, word.find('=')), options);
  }
  WordSet commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.insert(command->get_name());
  if (words.empty() || words.front().starts_with("-") || commands.empty() || !app.get_subcommands().empty())
    return {FaultCode::bad_usage, e.what()};
  return unknown_word("command", words.front(), commands);
}

/// Lines that a program understands, from which its errors take what to type.
using Examples = std::vector<std::string>;

/// @return what to type: the first example that begins like the command and has the word in it, or has the word only;
///         without one, where to look
inline std::string what_to_type(const Examples& examples, const std::string& command,
                                const std::string& word) {
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

/// What the examples at the end of a help show: lines that begin as typed() wants it, and what they do.
using ExplainedLines = std::vector<std::pair<std::string, std::string>>;

/// @return them as typed(), below each other, with what they do in a column of its own
inline std::string explained(ExplainedLines lines) {
  std::size_t width = 0;
  for (auto& [line, does] : lines) {
    line = typed(line);
    width = std::max(width, line.size());
  }
  std::string text;
  for (const auto& [line, does] : lines)
    text += does.empty() ? fmt::format("  {}\n", line) : fmt::format("  {:<{}}   {}\n", line, width, does);
  return text;
}

/// @param names  of one thing or several
/// @return "A, B and C"
inline std::string listed(const std::vector<std::string>& names) {
  if (names.empty()) return "";
  const std::string before = fmt::format("{}", fmt::join(names.begin(), names.end() - 1, ", "));
  return before.empty() ? names.back() : fmt::format("{} and {}", before, names.back());
}

/// @return an option or a place of the line with what it is for: "RUN (the run folder)"
inline std::string with_description(const CLI::Option& o) {
  std::string name = o.get_name();
  if (o.get_positional())
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
  return o.get_description().empty() ? name : fmt::format("{} ({})", name, o.get_description());
}

/// @param examples  lines that the program understands
/// @return bad_usage for a line that CLI11 refuses: words that do not exist or are missing are named, with what to type
inline FaultError wrong_words(const CLI::App& app, const CLI::Error& e, const Examples& examples = {}) {
  const CLI::App* at = &app;  // the command that was reached
  std::string command = app.get_name();
  for (auto inner = at->get_subcommands(); !inner.empty(); inner = at->get_subcommands()) {
    at = inner.back();
    command += (command.empty() ? "" : " ") + at->get_name();
  }
  const bool required = dynamic_cast<const CLI::RequiredError*>(&e) != nullptr;
  if (dynamic_cast<const CLI::ExtrasError*>(&e) || (required && !app.remaining(true).empty()))
    return unknown_word(app, e);
  if (required) {
    std::vector<std::string> missing;
    for (const CLI::Option* o : at->get_options())
      if (o->get_required() && o->count() == 0) missing.push_back(with_description(*o));
    if (missing.empty() && at->get_subcommands(nullptr).empty()) return {FaultCode::bad_usage, e.what()};
    if (missing.empty()) {
      for (const CLI::App* inner : at->get_subcommands(nullptr)) missing.push_back(inner->get_name());
      return {FaultCode::bad_usage, fmt::format("a command is missing; there are {}", listed(missing)),
              what_to_type(examples, command, "")};
    }
    return {FaultCode::bad_usage,
            fmt::format("{} {} missing", listed(missing), missing.size() == 1 ? "is" : "are"),
            what_to_type(examples, command, "")};
  }
  // "--session: 1 required NAME missing", "--url requires --session"
  const std::string said = e.what(), name = said.substr(0, said.find_first_of(" :"));
  const CLI::Option* option = at->get_option_no_throw(name);
  if (!option) option = app.get_option_no_throw(name);
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) && option && option->count() == 0)
    return {FaultCode::bad_usage, fmt::format("a value is missing behind {}", with_description(*option)),
            what_to_type(examples, command, fmt::format(" {} ", name))};
  const bool requires_another = dynamic_cast<const CLI::RequiresError*>(&e) != nullptr;
  return {FaultCode::bad_usage, said,
          what_to_type(requires_another ? examples : Examples{}, command, fmt::format(" {} ", name))};
}

/// Takes apart the words behind the name of a command.
/// @param out       gets the help that was asked for
/// @param err       is told what is wrong
/// @param examples  lines that the program understands
/// @return exit status when there is nothing more to do
inline std::optional<int> parse_words(CLI::App& app, const std::vector<std::string>& words, std::ostream& out,
                                      std::ostream& err, const Examples& examples = {}) {
  if (const auto help = help_asked(app, words)) {
    out << *help;
    return 0;
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return std::nullopt;
  } catch (const CLI::Error& e) {
    err << wrong_words(app, e, examples).error_line() << std::endl;
    return exit_status(FaultCode::bad_usage);
  }
}

}  // namespace mrroc
