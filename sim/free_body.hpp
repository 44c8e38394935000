// A rigid body in the work cell that belongs to no robot: its parameters, its pedestal and its true state.
#pragma once
#include <array>

#include "base/free_body.hpp"
#include "base/pose.hpp"

namespace mrroc::sim {

/// A body that can be touched by palms (sim/palm.hpp), by its pedestal and by the floor. At the beginning it rests on the
/// pedestal: a plate that is open in the middle, so that a ball sits in the opening and a box lies across it.
struct FreeBodyParameters : FreeBodyDescription {
  /// Radius of the patch in which a rubber palm lies against a ball: its friction resists spinning about the normal [m].
  double patch{0.008};
  double pedestal_edge{0.12};     ///< of the pedestal's upper side, which is square [m]
  double pedestal_opening{0.04};  ///< edge of the opening in it [m], below the body's size
};

/// @return how high the middle of the body is above the pedestal's upper side when it rests there [m]
[[nodiscard]] double resting_height(const FreeBodyParameters& parameters);

/// The true state, for tests and figures.
struct FreeBodyTruth {
  Pose T_UO;                          ///< in the world
  Vector3 velocity{Vector3::Zero()};  ///< of its middle, in the world [m/s]
  std::array<double, 2> press{};  ///< normal force of the palms of the first two arms, mean over the step [N]
  bool on_pedestal{};             ///< it touched the pedestal in the step
  bool on_floor{};                ///< it touched the floor in the step
};

}  // namespace mrroc::sim
