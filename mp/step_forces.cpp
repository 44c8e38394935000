#include "mp/step_forces.hpp"

#include <algorithm>
#include <iterator>

#include "mrroc/step_samples_t.hpp"

namespace mrroc::mp {

void add_step_forces(ArmTrace& trace, const link::LogReader& log, const std::string& arm) {
  const auto told = log.messages<step_samples_t>(arm + ".samples");
  for (ArmRow& row : trace) {
    // The driver's reply and its samples are stamped one macrostep before the agent's report, which the row is of.
    const auto found = told.find(row.i - 1);
    if (found == told.end()) continue;
    const step_samples_t& m = found->second;
    const auto n = std::clamp<std::int32_t>(m.n, 0, static_cast<std::int32_t>(std::size(m.sample)));
    Wrench most = row.F;
    for (std::int32_t k = 0; k < n; ++k)
      for (const Axis a : kAxes) most[a] = std::max(most[a], m.sample[k].F_a[static_cast<std::size_t>(a)]);
    row.F_most = most;
  }
}

}  // namespace mrroc::mp
