// The camera to which faces of the cube are shown.
#pragma once
#include "base/camera_config.hpp"

namespace mrroc::rubik {

/// Looks straight at the place where faces are shown, viewing_place() (tasks/rubik/cell/layout.hpp).
/// @return a camera "cube" that stands in the world, 640 x 480, without distortion, a picture every 0.2 s
CameraSetup cube_camera();

}  // namespace mrroc::rubik
