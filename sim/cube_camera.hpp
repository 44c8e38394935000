// The camera that faces of the cube are shown to.
#pragma once
#include "base/camera_config.hpp"

namespace mrroc::sim {

/// Looks straight at the place where faces are shown, viewing_place() (sim/cube_cell.hpp).
/// @return a camera "cube" that stands in the world, 640 x 480, without distortion, a picture every 0.2 s
CameraSetup cube_camera();

}  // namespace mrroc::sim
