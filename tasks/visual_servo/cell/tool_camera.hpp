// Where the tool's camera really is, for the figures of a run.
#pragma once
#include "base/config.hpp"
#include "base/pose.hpp"

namespace mrroc::visual_servo {

/// A camera in the hand can only know where the object is relative to itself. What it takes for the displacement e of E is
/// that of the place at which E would be if the camera were where it is believed.
/// @param config  of a run
/// @return D: it takes e for D * e; identity when the camera is where it is believed, or there is none
/// @throws ConfigError
[[nodiscard]] Pose tool_camera_error(const Config& config);

}  // namespace mrroc::visual_servo
