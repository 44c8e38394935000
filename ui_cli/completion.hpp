// Completes ui_cli's words in the user's shell.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace mrroc::ui {

/// One command of the program.
struct CompletedCommand {
  std::string name;                ///< first word behind `ui_cli`
  std::string about;               ///< one line
  std::vector<std::string> words;  ///< options, and words that may follow
};

/// @return script for bash, to be read with `source <(ui_cli completion bash)`
[[nodiscard]] std::string bash_completion(std::span<const CompletedCommand> commands);
/// @return script for zsh, to be read with `source <(ui_cli completion zsh)`
[[nodiscard]] std::string zsh_completion(std::span<const CompletedCommand> commands);

}  // namespace mrroc::ui
