// Checks a reading of the driver before a virtual sensor uses it.
#pragma once
#include <algorithm>
#include <cmath>

#include "base/effector_command.hpp"

namespace mrroc::vsp {

/// Beyond this nothing is a position [m], an angle [rad] or a force [N]; squares of it are still numbers.
inline constexpr double kNoReading = 1e6;

/// @return whether all numbers of a sample are finite and possible. A single one that is not would stay in a
/// sensor's filters for ever. Real-time safe.
[[nodiscard]] inline bool is_reading(const StepSample& sample) noexcept {
  const auto possible = [](double x) { return std::abs(x) < kNoReading; };  // false for NaN
  return std::ranges::all_of(sample.T_0E, possible) && std::ranges::all_of(sample.F_a.v, possible);
}

}  // namespace mrroc::vsp
