// Motion of an arm's tool.
#pragma once
#include <Eigen/Geometry>

#include "base/pose.hpp"

namespace mrroc::sim {

/// Motion of the tool in the world.
struct ToolMotion {
  Pose T_UG;                                  ///< frame of the tool's link, origin in the mass centre
  Vector3 velocity{Vector3::Zero()};          ///< of the mass centre [m/s]
  Vector3 angular_velocity{Vector3::Zero()};  ///< [rad/s]

  /// @param point_G  fixed to the tool, in its link's frame @return its velocity in the world [m/s]
  [[nodiscard]] Vector3 velocity_of(const Vector3& point_G) const {
    return velocity + angular_velocity.cross(T_UG.R * point_G);
  }
};

}  // namespace mrroc::sim
