// Makes the bodies of the cell's pictures, and defines the colours that several of them share.
#pragma once
#include "base/pose.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::sim {

/// Colours of links and of what is dark on them.
inline constexpr camera::Colour kSteel{0.55, 0.56, 0.58};
inline constexpr camera::Colour kDark{0.17, 0.17, 0.19};

/// @param size   along the body's axes [m] @param T_UB  of the body in the world
/// @param shine  of its surface, 0..1
[[nodiscard]] inline camera::Body body(Shape shape, const Vector3& size, const Pose& T_UB,
                                       const camera::Colour& colour, double shine = 0.1) {
  camera::Body b;
  b.shape = shape;
  b.size = size;
  b.T_UB = T_UB;
  b.colour = colour;
  b.shine = shine;
  return b;
}

/// @return the frame moved along its own axes [m]
[[nodiscard]] inline Pose at(const Pose& T, const Vector3& place) {
  return T * Pose{Matrix3::Identity(), place};
}

}  // namespace mrroc::sim
