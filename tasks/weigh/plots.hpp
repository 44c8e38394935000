// The picture of a run: forces and moments over the three orientations, and the tool's data computed from
// them.
#pragma once
#include "base/time_chart.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::weigh {

/// @param trace  of the arm @return forces and moments in the wrist over time, from arm1.csv, with the means of the two
///               readings and the tool that was found, if both were taken
[[nodiscard]] TimeChart forces_chart(const mp::ArmTrace& trace);

}  // namespace mrroc::weigh
