// Writes commands as the user types them: `./run ui_cli` in a clone, `mrroc ui_cli` or `ui_cli` otherwise.
#pragma once
#include <string>
#include <string_view>

namespace mrroc {

/// The command that starts all programs by their names is told by the environment, in this variable: `./run` sets it to
/// what was typed for it, the installed command to `mrroc`. Without it programs are in PATH.
inline constexpr const char* kCalledVariable = "MRROC_CALLED";

/// @param command  begins with the name of a program, or with ./run and that name: "ui_cli status", "./run press"
/// @param session  that it is about; empty: it need not be named
/// @return the line to type: "./run ui_cli status --session cell" in a clone, "mrroc ui_cli ..." where that was called,
///         otherwise as it stands. The session stands behind commands of ui_cli that speak with one and name none
[[nodiscard]] std::string typed(std::string_view command, std::string_view session = {});

/// Call this when printing a message, not when building it: messages, logs and files are the same for
/// everybody.
/// @param text     with commands between backquotes, and behind "Usage: "
/// @param session  as above
/// @return the text, where commands of ui_cli, of ./run, and of the running program are typed(). A lone name that is
///         not ui_cli is no command
[[nodiscard]] std::string command_hint(std::string_view text, std::string_view session = {});

}  // namespace mrroc
