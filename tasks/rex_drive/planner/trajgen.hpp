// The trajectory planner of c_1 as a value, with the auxiliary functions of REX algorithms 4-8. Another method of planning
// would be another leg() and nothing else.
#pragma once
#include <array>
#include <cstdint>

#include "base/platform_path.hpp"
#include "tasks/rex_drive/plan/proc.hpp"

namespace mrroc::rex_drive {

/// What a fragment must keep to: limits of the effector driver with a reserve.
struct PathLimits {
  double speed{1.47};      ///< v [m/s]
  double turn_rate{2.15};  ///< |w| [rad/s]
  double lateral{1.96};    ///< |v w| [m/s^2]
};

/// Constant parameters of the planner.
struct PlannerParameters {
  PathLimits path;    ///< no fragment goes beyond
  RouteLimits route;  ///< wanted
  int planning{
      5};  ///< time that a fragment takes, as declared [macrosteps]: planning and execution are concurrent
  double lead{
      1.08};  ///< before a fragment's end the driver asks for the next one [s]: its horizon and the way there
};

/// A piece of trajectory that has been planned.
struct Trajectory {
  std::array<PathPoint, kFragmentKnots> knot{};  ///< evenly over its duration
  double duration{};                             ///< [s], a multiple of kPlatformPeriod
  std::int32_t index{};                          ///< of the plan's point at its end
  std::int32_t iterations{};                     ///< of the search
};

/// @return the trajectory from one point to another one, found: false when there is none within the limits. Where it would
///         break them it is given more time, at most four times
struct Leg {
  bool found{};             ///< false: the rest means nothing
  Trajectory trajectory{};  ///< begins at `from` and ends at the point, maybe slower than wanted
};
[[nodiscard]] Leg plan_leg(const PathPoint& from, const PlanPoint& to, const PlannerParameters& k);

/// trajgen of REX: the planner's structure. Every function is pure and gives the next value.
struct Trajgen {
  PlannerParameters k{};   ///< constant during a run
  PathPoint at{};          ///< the last processed position: where the next trajectory begins
  bool busy{};             ///< it plans
  bool failed{};           ///< it has found no trajectory; then it is not ready any more
  std::int32_t elapsed{};  ///< since it was started [macrosteps]
  Trajectory found{};      ///< while it plans: the result, which counts when it is ready
};

/// trajgenInit: the planner begins at that state, and is idle.
[[nodiscard]] Trajgen trajgen_init(const Trajgen& trajgen, const PathPoint& state);
/// trajgenStart: begins to plan from the last processed position to the point.
[[nodiscard]] Trajgen trajgen_start(const Trajgen& trajgen, const PlanPoint& point);
/// trajgenStop: planning has come to its end.
[[nodiscard]] Trajgen trajgen_stop(const Trajgen& trajgen);
/// trajgenGetStat: the planner's state in the next macrostep.
[[nodiscard]] Trajgen trajgen_get_stat(const Trajgen& trajgen);
/// trajgenIsReady: there is a trajectory. Of a failed planner never.
[[nodiscard]] bool trajgen_is_ready(const Trajgen& trajgen);
/// trajgenGetTraj: the trajectory, when there is one.
[[nodiscard]] const Trajectory& trajgen_get_traj(const Trajgen& trajgen);

/// trajToSteps: iterations that its execution takes.
[[nodiscard]] std::int32_t traj_to_steps(const Trajectory& traj);
/// trajToNotify: iteration after which the effector driver is to say that it is ready; of a trajectory that is shorter than the
/// lead it is negative, before its beginning. @param lead  [s], at most kMaxFragmentSteps iterations
[[nodiscard]] std::int32_t traj_to_notify(const Trajectory& traj, double lead);

}  // namespace mrroc::rex_drive
