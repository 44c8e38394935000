#include "mp/step_forces.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <map>

#include "base/latency.hpp"
#include "mrroc/step_samples_t.hpp"

namespace mrroc::mp {
namespace {

/// The largest of no force at all.
constexpr double kNone = -std::numeric_limits<double>::infinity();

}  // namespace

void add_step_forces(ArmTrace& trace, const link::LogReader& log, const std::string& arm) {
  const auto told = log.messages<step_samples_t>(arm + ".samples");
  Wrench none;
  std::ranges::fill(none.v, kNone);
  std::map<std::int64_t, Wrench>
      most;  // of the samples of a macrostep, which come in one message or in several
  for (const auto& [number, m] : told) {
    const auto n = std::clamp<std::int32_t>(m.n, 0, static_cast<std::int32_t>(std::size(m.sample)));
    Wrench& F = most.try_emplace(m.macrostep, none).first->second;
    for (std::int32_t k = 0; k < n; ++k)
      for (const Axis a : kAxes) F[a] = std::max(F[a], m.sample[k].F_a[static_cast<std::size_t>(a)]);
  }
  for (ArmRow& row : trace) {
    // The driver's samples are stamped as its reply; the row is of the agent's report about that.
    const auto found = most.find(row.i - latency::kReplyToReport);
    if (found == most.end()) continue;
    Wrench& F = row.F_most.emplace(row.F);
    for (const Axis a : kAxes) F[a] = std::max(F[a], found->second[a]);
  }
}

}  // namespace mrroc::mp
