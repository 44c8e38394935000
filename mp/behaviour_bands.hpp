// The behaviours that an arm executed, with their times: for charts over time.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/time_chart.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::mp {

/// @param name  of a behaviour by its number
/// @return stretches of rows with the same m, in the order of time; those with m = 0 are left out
[[nodiscard]] std::vector<TimeBand> behaviour_bands(const ArmTrace& trace,
                                                    const std::function<std::string(int m)>& name);

/// @return time of the first and of the last row of any arm [s], at least one second apart; (0, 1) without a row
[[nodiscard]] std::pair<double, double> times_of(const std::vector<ArmTrace>& traces);

}  // namespace mrroc::mp
