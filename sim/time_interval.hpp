// Times in which something is wrong with what is simulated.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

#include "base/config.hpp"

namespace mrroc::sim {

/// Time from one second to another.
struct TimeInterval {
  double from{};  ///< [s]
  double to{};    ///< [s], not in it
};
using TimeIntervals = std::vector<TimeInterval>;

/// @return whether a time [s] is in the interval
[[nodiscard]] inline bool contains(const TimeInterval& interval, double time) {
  return time >= interval.from && time < interval.to;
}
/// @return whether a time [s] is in one of them
[[nodiscard]] inline bool contains(const TimeIntervals& intervals, double time) {
  return std::ranges::any_of(intervals, [time](const TimeInterval& i) { return contains(i, time); });
}

/// @param key  with its tables @return pairs of times `from, to, from, to...` [s]; none by default
/// @throws FaultError bad_configuration: they are no pairs, or one ends before it begins; ConfigError
[[nodiscard]] TimeIntervals read_times(const Config& config, const std::string& key);

}  // namespace mrroc::sim
