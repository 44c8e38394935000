// What the command lines of all programs say of a word that does not exist.
#pragma once
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/nearest.hpp"

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
  return command->help(before);
}

/// The same for the command line of a program, which gives the app its name if it has none.
inline std::optional<std::string> help_asked(CLI::App& app, int argc, const char* const* argv) {
  if (app.get_name().empty() && argc > 0) app.name(argv[0]);
  return help_asked(app, std::vector<std::string>(argv + std::min(argc, 1), argv + argc));
}

/// Takes apart the words behind the name of a command.
/// @param out  gets the help that was asked for @param err  is told what is wrong
/// @return exit status when there is nothing more to do
inline std::optional<int> parse_words(CLI::App& app, const std::vector<std::string>& words, std::ostream& out,
                                      std::ostream& err) {
  if (const auto help = help_asked(app, words)) {
    out << *help;
    return 0;
  }
  try {
    app.parse(std::vector<std::string>(words.rbegin(), words.rend()));
    return std::nullopt;
  } catch (const CLI::Error& e) {
    err << FaultError(FaultCode::bad_usage, e.what(), fmt::format("look at `{} --help`", app.get_name()))
               .error_line()
        << std::endl;
    return exit_status(FaultCode::bad_usage);
  }
}

/// @return bad_usage for words that no command of the line knows, better than what CLI11 says where that is possible
inline FaultError unknown_word(const CLI::App& app, const CLI::ExtrasError& e) {
  const std::vector<std::string> words = app.remaining(true);
  for (const std::string& word : words) {
    if (!word.starts_with("--")) continue;
    WordSet options;
    add_options(app, options);
    for (const CLI::App* command : app.get_subcommands()) add_options(*command, options);
    return unknown_word("option", word.substr(0, word.find('=')), options);
  }
  if (words.empty() || words.front().starts_with("-") || !app.get_subcommands().empty())
    return {FaultCode::bad_usage, e.what()};
  WordSet commands;
  for (const CLI::App* command : app.get_subcommands(nullptr)) commands.insert(command->get_name());
  return unknown_word("command", words.front(), commands);
}

}  // namespace mrroc
