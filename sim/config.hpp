// The simulated world's part of the configuration, and its process.
#pragma once
#include "base/link/child_main.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// @return the parameters in [sim] and [robots.ARM]; arms as [robots] order says
/// @throws ConfigError
WorldParameters read_world(const Config& config);

/// Builds the world and runs its shell.
void run_world_process(link::Process& process, const Config& config, const link::PartArguments& arguments);

}  // namespace mrroc::sim
