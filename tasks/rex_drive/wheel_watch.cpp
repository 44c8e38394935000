#include "tasks/rex_drive/wheel_watch.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace mrroc::rex_drive {
namespace {

constexpr std::size_t kKept = 25;  // estimates: half a second
constexpr double kStill = 1e-3;    // way [m] and turn [rad] that pictures of a camera that hangs may show
constexpr double kTurned = 0.06;   // mean of the wheels: from there on something must be seen to move [rad]
constexpr std::int64_t kNearStep = 9;  // an estimate of this many steps before is that of a step

std::optional<PerWheel> angles_at(const WheelWatch& watch, std::int64_t step) {
  const auto later = std::ranges::upper_bound(watch, step, {}, &WheelAngles::step);
  if (later == watch.begin()) return {};
  const WheelAngles& found = *std::prev(later);
  if (step - found.step > kNearStep) return {};
  return found.theta;
}

bool shows_no_motion(const OdometryReading& reading) {
  const auto& A = reading.A;
  return std::hypot(A[3], A[7]) < kStill && std::abs(std::atan2(A[4], A[0])) < kStill;
}

}  // namespace

WheelWatch watched(WheelWatch watch, const PlatformEstimate& estimate) {
  if (!watch.empty() && estimate.step <= watch.back().step) return watch;
  if (watch.size() == kKept) watch.erase(watch.begin());
  watch.push_back({estimate.step, estimate.theta});
  return watch;
}

bool stands_against_wheels(const OdometryReading& reading, const WheelWatch& watch) {
  if (!reading.valid || !shows_no_motion(reading)) return false;
  const auto before = angles_at(watch, reading.step_before);
  const auto now = angles_at(watch, reading.step);
  if (!before || !now) return false;
  double sum = 0;
  for (std::size_t k = 0; k < now->size(); ++k) sum += std::abs((*now)[k] - (*before)[k]);
  return sum > kTurned * static_cast<double>(now->size());
}

}  // namespace mrroc::rex_drive
