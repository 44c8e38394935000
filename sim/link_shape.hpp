// The visible shapes of an arm, from its description.
#pragma once
#include <string>

#include "base/pose.hpp"
#include "base/shape.hpp"

namespace mrroc::sim {

/// One shape and the link that it is fixed to.
struct LinkShape {
  std::string link;               ///< name in the description
  Shape shape{};                  ///< its form
  Vector3 size{Vector3::Zero()};  ///< along its own axes [m]
  Pose T_UV;                      ///< its middle in the world
};

}  // namespace mrroc::sim
