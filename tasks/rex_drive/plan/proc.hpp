// proc of REX algorithm 4: adds what a plan does not say to its points, orientations above all.
#pragma once
#include <numbers>
#include <vector>

#include "base/platform_transmission.hpp"

namespace mrroc::rex_drive {

/// A turn of the way by more than this is made on the spot [rad].
inline constexpr double kPivotAngle = std::numbers::pi / 3;

/// How fast the platform may go along a plan.
struct RouteLimits {
  double lateral{1.0};       ///< v w [m/s^2]
  double acceleration{0.6};  ///< v' [m/s^2]
  double turn_rate{1.5};     ///< w of a curve, and the largest of a turn on the spot [rad/s]
};

/// A point of the plan, with everything that the planner needs.
struct PlanPoint {
  PathPoint at{};        ///< pose, and speeds there; phi is unwrapped along the route
  double cruise{};       ///< speed wanted on the way to it [m/s]; 0: a turn on the spot
  std::int32_t index{};  ///< of the plan's point that it belongs to, from 0: the operator's "point 7"
};
using Route = std::vector<PlanPoint>;  ///< plan of REX, c_c1[plan]

/// @param angle  of a turn on the spot [rad]
/// @return how long it takes with the least jerk and that largest turn rate [s]
[[nodiscard]] double time_of_turn(double angle, double turn_rate);

/// Completes the points of a plan. Points nearer than kSamePoint to the one before are left out, legs longer than 5 m, or
/// 3.5 s, are divided, and so are turns on the spot that last longer than a fragment. At points that are passed the orientation is near that of the chord between the neighbours, and
/// the curvature of the way is continuous; at the last point and on both sides of a turn on the spot the orientation is
/// that of the leg. Speeds obey the limits in curves and when they change; the platform rests at a turn on the spot, and
/// at the last point unless the plan knows points ahead.
/// @param from  where the route begins; at rest, or in motion along its heading
/// @return empty when no point is far enough from `from`
[[nodiscard]] Route proc(const Plan& desired_plan, const PathPoint& from, const RouteLimits& limits);

}  // namespace mrroc::rex_drive
