// Poses in the plane, one in the frame of another.
#pragma once
#include <cmath>

#include "base/platform_path.hpp"

namespace mrroc {

/// @param frame  a pose  @param p  a pose given in the frame of that one
/// @return p where `frame` is given; its heading is the sum of both, not wrapped
[[nodiscard]] inline PlanarPose chained(const PlanarPose& frame, const PlanarPose& p) {
  const double c = std::cos(frame.phi), s = std::sin(frame.phi);
  return {frame.x + c * p.x - s * p.y, frame.y + s * p.x + c * p.y, frame.phi + p.phi};
}

/// @return p in the frame of `frame`; phi wrapped
[[nodiscard]] inline PlanarPose seen_from(const PlanarPose& frame, const PlanarPose& p) {
  const double c = std::cos(frame.phi), s = std::sin(frame.phi);
  const double x = p.x - frame.x, y = p.y - frame.y;
  return {c * x + s * y, c * y - s * x, wrap_angle(p.phi - frame.phi)};
}

/// @return the frame of the pose's frame, as it is seen from the pose
[[nodiscard]] inline PlanarPose inverse(const PlanarPose& p) { return seen_from(p, {}); }

/// @return distance between two places [m]
[[nodiscard]] inline double distance(const PlanarPose& a, const PlanarPose& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

}  // namespace mrroc
