// The command `ui_cli config [--truth] [TASK]`: lists what can be set with --set, by asking the tasks' programs.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace mrroc::ui {

/// Words behind `ui_cli config`, for the shell's completion: options and tasks.
[[nodiscard]] std::vector<std::string> config_words();

/// Runs the command. @param arguments behind the word config
/// @return exit status: 0 done; 2 bad usage; that of the task's program
/// @throws FaultError  bad_usage: no such task; start_failed: its program is not there
int run_config(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
