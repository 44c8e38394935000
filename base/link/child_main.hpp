// main() of every program that a task starts: world, edp, ecp, vsp.
#pragma once
#include <functional>
#include <string>

#include "base/config.hpp"
#include "base/link/process.hpp"

namespace mrroc::link {

/// What a part is told besides the configuration.
struct PartArguments {
  std::string arm;  ///< which arm it belongs to, empty for the world
};

/// What a part does: builds its kernel from the configuration and runs its shell.
using PartBody = std::function<void(Process& process, const Config& config, const PartArguments& arguments)>;

/// Joins the system that the arguments name and runs the body; faults are reported to the supervisor.
/// `--help` explains the arguments, so that every part can be started by hand.
/// @param about  one sentence for --help
/// @return exit status: 0 done, 2 bad arguments or configuration, 3 system error
int child_main(int argc, char** argv, const std::string& about, const PartBody& body);

}  // namespace mrroc::link
