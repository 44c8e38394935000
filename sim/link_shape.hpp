// What an arm looks like: the simple shapes of its description.
#pragma once
#include <string>

#include "sim/camera/scene.hpp"

namespace mrroc::sim {

/// One shape and the link that it is fixed to.
struct LinkShape {
  std::string link;               ///< name in the description
  camera::Shape shape{};          ///< its form
  Vector3 size{Vector3::Zero()};  ///< along its own axes [m]
  Pose T_UV;                      ///< its middle in the world
};

}  // namespace mrroc::sim
