// The command `ui_cli log`: shows, checks, compares and plots run folders.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace mrroc::ui {

/// Words behind `ui_cli log`, for the shell's completion.
[[nodiscard]] std::vector<std::string> log_words();

/// Runs the command. @param arguments behind the word log
/// @return exit status: 0, 1 when runs differ or a run cannot be recomputed, 2 for bad usage or no run folder, 3
///         system error
int run_log(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
