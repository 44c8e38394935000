#include "tasks/rex_drive/wheel_watch.hpp"

#include <algorithm>

namespace mrroc::rex_drive {
namespace {

constexpr std::size_t kKept = 25;      // estimates: half a second
constexpr std::int64_t kNearStep = 9;  // an estimate of this many steps before is that of a step

}  // namespace

WheelWatch watched(WheelWatch watch, const PlatformEstimate& estimate) {
  if (!watch.empty() && estimate.step <= watch.back().step) return watch;
  if (watch.size() == kKept) watch.erase(watch.begin());
  watch.push_back({estimate.step, estimate.theta});
  return watch;
}

std::optional<PerWheel> angles_at(const WheelWatch& watch, std::int64_t step) {
  const auto later = std::ranges::upper_bound(watch, step, {}, &WheelAngles::step);
  if (later == watch.begin()) return {};
  const WheelAngles& found = *std::prev(later);
  if (step - found.step > kNearStep) return {};
  return found.theta;
}

}  // namespace mrroc::rex_drive
