// Plans all plans of a run at once, without driving: to find out before anything moves whether there is a trajectory.
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/platform_transmission.hpp"
#include "tasks/rex_drive/planner/trajgen.hpp"

namespace mrroc::rex_drive {

/// A point to which the planner has found no trajectory.
struct MissedPoint {
  std::int64_t plan{};   ///< number of the plan
  std::int32_t point{};  ///< of it, from 0
  PlanarPose at;         ///< where it is
};

/// A trajectory to a point of a plan.
struct FoundTrajectory {
  std::int64_t plan{};    ///< number of the plan
  Trajectory trajectory;  ///< to the point with its index
};

/// What the planner has found.
struct PlannerSurvey {
  std::vector<FoundTrajectory> found;  ///< all trajectories, in their order
  std::optional<MissedPoint>
      missed;         ///< the first point of no trajectory; what is behind it has not been planned
  double duration{};  ///< of all of them [s]
};

/// @param start  where the platform stands
[[nodiscard]] PlannerSurvey survey(const std::vector<Plan>& plans, const PlanarPose& start,
                                   const PlannerParameters& k);

}  // namespace mrroc::rex_drive
