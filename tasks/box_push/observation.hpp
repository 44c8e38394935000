// Means of poses that were measured of something that stands.
#pragma once
#include "base/planar.hpp"

namespace mrroc::box_push {

/// The mean of the poses so far.
struct PoseMean {
  int n{};             ///< poses
  PlanarPose first{};  ///< the first one
  PlanarPose sum{};    ///< of the differences from it
};

/// @return the mean with one pose more
[[nodiscard]] inline PoseMean with(PoseMean mean, const PlanarPose& p) {
  if (mean.n == 0) mean.first = p;
  mean.sum.x += p.x - mean.first.x;
  mean.sum.y += p.y - mean.first.y;
  mean.sum.phi += wrap_angle(p.phi - mean.first.phi);
  ++mean.n;
  return mean;
}

/// @return the mean of at least one pose; phi wrapped
[[nodiscard]] inline PlanarPose pose_of(const PoseMean& mean) {
  const PlanarPose& p = mean.first;
  return {p.x + mean.sum.x / mean.n, p.y + mean.sum.y / mean.n, wrap_angle(p.phi + mean.sum.phi / mean.n)};
}

}  // namespace mrroc::box_push
