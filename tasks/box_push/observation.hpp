// Where something stands that was measured some times, by readings of which single ones are far off.
#pragma once
#include <vector>

#include "base/planar.hpp"

namespace mrroc::box_push {

/// Readings further than this from the middle one, along x, y or phi, are no measurements of it.
inline constexpr double kAgrees = 0.1;        // [m]
inline constexpr double kTurnedAgrees = 0.2;  // [rad]

/// @param readings  at least one
/// @return the mean of those that agree with the medians of all; phi wrapped
[[nodiscard]] PlanarPose pose_of(const std::vector<PlanarPose>& readings);

}  // namespace mrroc::box_push
