// Limits of the drivers in the cell of the cube, where no process of the task runs.
#pragma once
#include <vector>

#include "edp/limits.hpp"

namespace mrroc::rig {

/// @return of each arm, by its number in test/rig/cube_cell.hpp: those of the task's own configuration
std::vector<edp::Limits> cube_limits();

}  // namespace mrroc::rig
