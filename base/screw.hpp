// exp and log on SE(3): rigid motion with a constant velocity, and means of poses.
#pragma once
#include "base/pose.hpp"

namespace mrroc {

/// exp on SE(3): where a frame is after moving with a constant velocity given in the moving frame itself. Real-time
/// safe.
/// @param v  [m/s], [rad/s]  @param time  [s]
/// @return pose of the frame in the place where it began
Pose exp_screw(const Twist& v, double time = 1);

/// log on SE(3), the inverse of exp_screw over one second. Real-time safe.
/// @param T  a displacement of less than half a turn; at half a turn the axis is that of angle_axis_from_rotation()
/// @return the velocity [m, rad per second] that leads there in one second
Twist log_screw(const Pose& T);

}  // namespace mrroc
