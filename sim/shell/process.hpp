// The simulator's process.
#pragma once
#include "base/link/child_main.hpp"

namespace mrroc::sim {

/// Builds the World and runs the simulator's shell.
void run_simulator_process(link::Process& process, const Config& config,
                           const link::NodeArguments& arguments);

}  // namespace mrroc::sim
