#include "mp/behaviour_bands.hpp"

#include <algorithm>

namespace mrroc::mp {

std::vector<TimeBand> behaviour_bands(const ArmTrace& trace, const std::function<std::string(int)>& name) {
  return time_bands(
      trace, [](const ArmRow& row) { return row.t; }, [](const ArmRow& row) { return row.m; }, name);
}

std::pair<double, double> times_of(const std::vector<ArmTrace>& traces) {
  AxisRange times;
  for (const ArmTrace& trace : traces)
    for (const ArmRow& row : trace) times.add(row.t);
  if (times.empty()) return {0, 1};
  return {times.low, std::max(times.high, times.low + 1)};
}

}  // namespace mrroc::mp
