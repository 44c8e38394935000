// Limits of the spaces in which motions are planned, and the choice among several coordinates of one pose.
#pragma once
#include <vector>

#include "base/effector_command.hpp"
#include "ecp/generators/curve.hpp"

namespace mrroc::ecp {

/// Largest speeds and accelerations, per coordinate.
struct MotionLimits {
  Coordinates velocity;      ///< [rad/s], [m/s], above zero
  Coordinates acceleration;  ///< [rad/s^2], [m/s^2], above zero
};

/// The original's limits: motors 200 rad/s and 150 rad/s^2, joints 1.5 rad/s and 7 rad/s^2. For the pose of E
/// what the effector driver lets pass by default: 0.5 m/s and 2 rad/s, with 5 m/s^2 and 5 rad/s^2 (the
/// original had 5 throughout, ten times what its arms could do).
/// @param space  motors, joints, xyz_euler_zyz or xyz_angle_axis
/// @param axes   of the robot; counts for motors and joints
[[nodiscard]] MotionLimits default_limits(Representation space, int axes);

/// One orientation has many Euler angles and many rotation vectors, and a motion through their numbers takes
/// the long way round if they jump, for instance where the angle of a rotation passes pi.
/// @param space  only angles of poses are changed, motors and joints stay
/// @return the same pose in coordinates that are nearest to the pose before
[[nodiscard]] Coordinates nearest_coordinates(Representation space, const Coordinates& pose,
                                              const Coordinates& before);

/// Relative poses added up (MG tab. 1): motors and joints by addition, poses by multiplication on the right.
/// @param increments  each relative to the one before
/// @return one pose more: the start, and then every pose relative to the start
[[nodiscard]] std::vector<Coordinates> accumulated(Representation space,
                                                   const std::vector<Coordinates>& increments);

}  // namespace mrroc::ecp
