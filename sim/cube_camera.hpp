// The camera that looks at the cube where the two arms meet.
#pragma once
#include "base/camera_config.hpp"
#include "base/cube_face.hpp"

namespace mrroc::sim {

/// Stands on the side of the cell that neither arm's elbow is on, 40 degrees from the direction in which the track
/// arm shows the cube: the line of sight passes the other arm's hand when that has gone back by 0.1 m, with 6 cm
/// to spare, and the camera is 0.38 m from its axis.
/// @return a camera "cube" in the world, 0.6 m from the cube, 640 x 480, without distortion
CameraSetup cube_camera();

/// @return T_UG of the face that the track arm shows at the meeting place, opposite to its palm: axes of the frame M
///         (sim/cube_cell.hpp), half a cube before its origin
Pose shown_place(const CubeFaceShape& shape = kCubeFace);

}  // namespace mrroc::sim
