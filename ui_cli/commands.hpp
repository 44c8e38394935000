// The program ui_cli.
#pragma once
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <memory>

#include "base/link/bus.hpp"
#include "base/link/lcm_bus.hpp"
#include "ui_cli/client.hpp"

namespace mrroc::ui {

/// What the program finds around it; tests give it something else.
struct Surroundings {
  std::ostream& out;
  std::ostream& err;
  std::filesystem::path sessions;  ///< directory of the running sessions
  std::function<std::unique_ptr<link::Bus>(const link::LcmAddress&)> open;
  Patience patience;
};

/// Runs the program; after an error its last line on err is `error: CODE: what happened; what to do`.
/// @return exit status: 0 done, 1 refused by the task, 2 bad usage or no such session, 3 system error
int run(int argc, const char* const* argv, const Surroundings& around);

}  // namespace mrroc::ui
