// Pictures of a run: the fixture and the way of the tool, and forces and deviation over time.
#pragma once
#include <string>

#include "base/time_chart.hpp"
#include "mp/arm_trace.hpp"
#include "tasks/guide/config.hpp"

namespace mrroc::guide {

/// @return gnuplot script of plots/fixture.png: the fixture from above its plane, the way of the tool while it holds and
///         before and after, from arm1.csv
[[nodiscard]] std::string fixture_script(const Setup& k);

/// @param trace  of the arm @return forces along and across, and the deviation, while the fixture holds
[[nodiscard]] TimeChart force_chart(const mp::ArmTrace& trace, const Setup& k);

}  // namespace mrroc::guide
