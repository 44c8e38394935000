// The ECP process of an arm of the drawing task.
#pragma once
#include "base/config.hpp"
#include "base/link/child_main.hpp"

namespace mrroc::drawing {

/// Prepares the effector and copies the coordinator's orders until the task is over.
void run_drawing_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::drawing
