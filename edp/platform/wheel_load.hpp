// Whether the load cells of the wheels are to be believed while the platform moves.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/platform_hardware.hpp"

namespace mrroc::edp {

/// The sum of the load cells may differ so much from the weight, as a share.
inline constexpr double kLoadError = 0.2;

/// @return what all wheels bear [N]. Real-time safe
[[nodiscard]] inline double total_load(const PerWheel& load) noexcept {
  return std::accumulate(load.begin(), load.end(), 0.);
}

/// @param measured  means of the load cells [N]  @param at_rest  those that were weighed; their sum is the weight [N]
/// @return false: not finite, negative, or their sum differs from the weight by more than kLoadError. Real-time safe
[[nodiscard]] inline bool is_believed(const PerWheel& measured, const PerWheel& at_rest) noexcept {
  const double weight = total_load(at_rest);
  const bool possible = std::ranges::all_of(measured, [](double N) { return std::isfinite(N) && N >= 0; });
  return possible && std::abs(total_load(measured) - weight) <= kLoadError * weight;
}

/// @param measured, at_rest  as is_believed() has them
/// @return forces on the wheels for the kernels: the measured ones, or those at rest when the cells are not to be believed.
///         Real-time safe
[[nodiscard]] inline PerWheel believed_load(const PerWheel& measured, const PerWheel& at_rest) noexcept {
  return is_believed(measured, at_rest) ? measured : at_rest;
}

}  // namespace mrroc::edp
