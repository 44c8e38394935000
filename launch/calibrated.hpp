// The configuration file that a calibration of the cell leaves, in tasks that have no use for all of it.
#pragma once
#include "base/config.hpp"

namespace mrroc::launch {

/// Reads what a calibration has found (tasks/calibrate_cell): cell.robots.ARM.place, robots.ARM.kinematics and
/// robots.ARM.tool of the arms that calibration.robots names, cell.cameras.KEY.pose of the cameras of calibration.cameras, so
/// that a task that has no such arm or camera, or plans nothing, takes the file nevertheless. Of all other names, misspelt ones
/// too, a key that nobody asks for is an error, as ever; without calibration.run of these as well.
/// @throws ConfigError  a value is not legal
void take_calibrated(const Config& config);

}  // namespace mrroc::launch
