// How well the arms have executed their plan.
#pragma once
#include <vector>

#include "mp/arm_trace.hpp"
#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {

/// Rows of an arm in which it executed one motion, or rested behind it.
struct Stretch {
  std::size_t first{}, last{};  ///< rows of the trace
};

/// @param m  behaviour @return its stretches, in their order
[[nodiscard]] std::vector<Stretch> stretches_of(const mp::ArmTrace& trace, int m);

/// Distance of two poses.
struct PoseError {
  double mm{};   ///< between their origins
  double deg{};  ///< of the turn from one to the other
};

/// @return error of E at rest behind each motion that has been executed; none of motions with axes in contact
[[nodiscard]] std::vector<PoseError> goal_errors(const mp::ArmTrace& trace, const ArmPlan& plan);

/// @return largest distance of E from the way of its set points, over all motions without axes in contact [mm]
[[nodiscard]] double path_error_mm(const mp::ArmTrace& trace, const ArmPlan& plan);

/// @param arms  traces, in the order of the plan's arms
/// @return per arm: goal_error_mm, goal_error_deg, path_error_mm, speed_pct, acceleration_pct, motion_s
[[nodiscard]] mp::TaskFigures figures(const std::vector<mp::ArmTrace>& arms, const Plan& plan);

}  // namespace mrroc::any_motion
