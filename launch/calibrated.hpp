// The configuration file that a calibration of the cell leaves, in tasks that have no use for all of it.
#pragma once
#include "base/config.hpp"

namespace mrroc::launch {

/// Reads what a calibration has found (tasks/calibrate_cell): cell.robots.ARM.place, robots.ARM.kinematics
/// and robots.ARM.tool of every arm in it, cell.cameras.KEY.pose of every camera,
/// so that a task that has no such arm or camera, or plans nothing, takes the file nevertheless. Without calibration.run nothing is
/// read: then a key that nobody asks for is an error, as ever.
/// @throws ConfigError  a value is not legal
void take_calibrated(const Config& config);

}  // namespace mrroc::launch
