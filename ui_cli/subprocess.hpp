// Starts other programs for a command.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace mrroc::ui {

/// End of a program.
struct Finished {
  int status{};     ///< exit status; 128 + signal; -1: it could not be started
  std::string out;  ///< what it wrote on standard output
};

/// Runs a program to its end; its standard error goes where this program's goes.
/// @param program  path, or a name that is looked for in PATH
/// @param folder   where it runs; empty: where this program runs
Finished run_program(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                     const std::filesystem::path& folder = {});

}  // namespace mrroc::ui
