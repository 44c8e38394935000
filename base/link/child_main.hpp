// main() of every program that a task starts: simulator, edp, ecp, vsp.
#pragma once
#include <functional>
#include <string>

#include "base/config.hpp"
#include "base/link/process.hpp"

namespace mrroc::link {

/// Settings of a node besides the configuration.
struct NodeArguments {
  std::string arm;         ///< which arm it belongs to, empty for the simulator
  std::string hardware{};  ///< of a driver: the kind of its hardware; empty: as the configuration says
};

/// The main function of a node: builds its kernel from the configuration and runs its shell.
using NodeMain = std::function<void(Process& process, const Config& config, const NodeArguments& arguments)>;

/// Joins the system that the arguments name and runs the body; faults are reported to the supervisor.
/// `--help` explains the arguments, so that every node can be started by hand.
/// @param about  one sentence for --help
/// @return exit status: 0 done, 2 bad arguments or configuration, 3 system error
int child_main(int argc, char** argv, const std::string& about, const NodeMain& body);

}  // namespace mrroc::link
