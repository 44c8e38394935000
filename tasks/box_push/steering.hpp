// How the pair is steered so that the box comes to a pose: it drives like a car, forward and along curves that are not too
// narrow, and the box goes with it.
#pragma once
#include <optional>

#include "base/planar.hpp"

namespace mrroc::box_push {

/// What a pair can do that pushes.
struct SteeringLimits {
  double radius{3.2};  ///< of the curves that are planned [m]
  /// Of the narrowest curve [m]: both platforms still push on it, and the box does not slip aside.
  double least_radius{2.0};
  double nearest{0.12};  ///< targets nearer than this are steered for as if they were so far [m]
};

/// How to go on to a target.
struct Course {
  double curvature{};  ///< to the left [1/m]
  double length{};     ///< of the way that is left [m]; not above 0: the target is beside or behind
};

/// @param target  in the frame of the pair, where it is to be in the end
/// @return the shortest way of arcs and a straight line between them (Dubins) with the planned radius, unless it is a long way
///         round
[[nodiscard]] std::optional<Course> planned_course(const PlanarPose& target, const SteeringLimits& k);

/// @param target  as before
/// @return such a way with the widest arcs that lead to the target: it turns at once, and what it misses can be made good by
///         narrower ones; where none lead there, what comes near
[[nodiscard]] Course course_to(const PlanarPose& target, const SteeringLimits& k);

}  // namespace mrroc::box_push
