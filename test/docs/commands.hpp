// The commands that README.md and docs/ tell people to type, and how each of them is tried.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace mrroc::test {

/// A command as it stands in a document.
struct Command {
  std::filesystem::path document;  ///< from the root, e.g. docs/operator.md
  int line{};                      ///< counted from 1
  std::string text;                ///< without prompt and remark
};

/// @param text  of a document in Markdown
/// @return its commands in order: lines of fenced blocks without a language, or of a shell, that begin with a program
///         of the project or a tool that people type, and words in code marks that do and have arguments
[[nodiscard]] std::vector<Command> commands_in(const std::filesystem::path& document,
                                               const std::string& text);

/// @return the commands of README.md and of all documents below docs/, each once: where it stands first
[[nodiscard]] std::vector<Command> document_commands(const std::filesystem::path& root);

/// How a command is tried.
struct Trial {
  std::string command;  ///< as in the documents
  std::string script;   ///< lines for a shell that stand for it; empty: it is run as it stands
  std::string not_run;  ///< why it is not run; empty: it is
  std::string
      stand_in{};  ///< what of it is another program's work, or left out, in the test; empty: nothing of weight
};

/// @return the words that a command begins with, up to the first placeholder, option or path: "ui_cli log show"
[[nodiscard]] std::string first_words(const std::string& command);

/// Reads test/docs/trials/*: "= COMMAND", below it either lines of a script, indented by two blanks, or one line
/// "! why it is not run". A line "~ WHY" tells of a stand-in. `@` in a script stands for the command.
/// @throws std::runtime_error that names a line which is neither
[[nodiscard]] std::vector<Trial> read_trials(const std::filesystem::path& root);

/// @return how this command is tried: as the file says, or as it stands
[[nodiscard]] Trial trial_of(const std::vector<Trial>& trials, const std::string& command);

}  // namespace mrroc::test
