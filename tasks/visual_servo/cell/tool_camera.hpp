// Where the tool's camera really is, for the figures of a run.
#pragma once
#include "base/config.hpp"
#include "base/pose.hpp"

namespace mrroc::visual_servo {

/// A camera in the hand can only know where the object is relative to itself, C_G T: it takes for E's displacement
/// E_C T C_G T (E_G T_d)^-1 with the place E_C T that is believed. With the true place E_C' T that is D e, where e is the true
/// displacement and D = E_C T (E_C' T)^-1.
/// @param config  of a run
/// @return D: it takes e for D * e; identity when the camera is where it is believed, or there is none
/// @throws ConfigError
[[nodiscard]] Pose tool_camera_error(const Config& config);

}  // namespace mrroc::visual_servo
