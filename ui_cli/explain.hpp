// The command `ui_cli explain CODE`: the meaning of an error, its usual cause, and the remedy.
#pragma once
#include <iosfwd>
#include <string>
#include <vector>

#include "base/fault.hpp"

namespace mrroc::ui {

/// @return a few lines for a person, from the table of errors
[[nodiscard]] std::string explanation(FaultCode code);

/// Words behind `ui_cli explain`, for the shell's completion: the codes.
[[nodiscard]] std::vector<std::string> explain_words();

/// Runs the command; without a code it lists all. @param arguments behind the word explain
/// @return exit status: 0, or 2 for bad usage
int run_explain(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err);

}  // namespace mrroc::ui
