// The command `ui_cli new robot|platform|task|sensor NAME`: writes the files of a new robot, platform, task or sensor.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

namespace mrroc::ui {

/// Words behind `ui_cli new`, for the shell's completion.
[[nodiscard]] std::vector<std::string> new_words();

/// Runs the command. @param arguments behind the word new
/// @return exit status: 0 done; 2 bad usage, nothing was written
/// @throws FaultError  bad_usage, cannot_write: nothing was written
int run_new(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
