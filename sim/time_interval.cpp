#include "sim/time_interval.hpp"

#include "base/fault.hpp"

namespace mrroc::sim {

TimeIntervals read_times(const Config& config, const std::string& key) {
  constexpr Bounds kTime{0, 1e6};  // [s]
  const auto times = config.list(key, std::vector<double>{}, kTime, "s from, to, from, to, ...");
  TimeIntervals intervals;
  for (std::size_t k = 0; k + 1 < times.size(); k += 2) intervals.push_back({times[k], times[k + 1]});
  if (times.size() % 2 != 0 ||
      std::ranges::any_of(intervals, [](const TimeInterval& i) { return i.from >= i.to; }))
    throw FaultError(FaultCode::bad_configuration,
                     key + ": pairs of times, each a beginning and a later end; or none");
  return intervals;
}

}  // namespace mrroc::sim
