// The program ui_cli.
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>
#include <string>
#include <vector>

#include "base/link/bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// A command that needs no running task and belongs to another part of the framework.
struct Tool {
  std::string name;   ///< first word behind `ui_cli`
  std::string about;  ///< one line for --help
  /// @return exit status. @param arguments behind the name
  std::function<int(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err)> run;
  std::vector<std::string> words{};  ///< that may follow, for the shell's completion
};

/// Streams, transport and tools of the program; tests give it something else.
struct Environment {
  std::ostream& out;               ///< what was asked for
  std::ostream& err;               ///< errors, and what they come from
  std::filesystem::path sessions;  ///< directory of the running sessions
  /// Makes a terminal's end of the transport.
  std::function<std::unique_ptr<link::Bus>(const link::SessionInfo&)> open;
  Timeouts timeouts;          ///< with the task
  std::vector<Tool> tools{};  ///< commands besides those that talk to a task
};

/// Runs the program; after an error its last line on err is `error: CODE: what happened; what to do`.
/// @return exit status: 0 done, 1 refused by the task, 2 bad usage or no such session, 3 system error
int run(int argc, const char* const* argv, const Environment& environment);

}  // namespace mrroc::ui
