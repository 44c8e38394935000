// The picture of an arm's run: positions, speeds and accelerations of its set points against their limits.
#pragma once
#include "base/time_chart.hpp"
#include "tasks/move/figures.hpp"

namespace mrroc::any_motion {

/// @param trace  of the arm @return joints, and shares of the limits, of the motions that it has executed
[[nodiscard]] TimeChart motion_chart(const mp::ArmTrace& trace, const ArmPlan& plan);

}  // namespace mrroc::any_motion
