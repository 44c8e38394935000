// The effector driver process of an IRb-6 arm.
#pragma once
#include "base/link/child_main.hpp"

namespace mrroc::irb6 {

/// Builds the arm's driver from [robots.ARM] and runs the shell.
/// @throws ConfigError
void run_edp_of_arm(link::Process& process, const Config& config, const link::PartArguments& arguments);

}  // namespace mrroc::irb6
