// Whether the load cells of the wheels are to be believed while the platform moves.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/platform_hardware.hpp"

namespace mrroc::edp {

/// The sum of the load cells may differ so much from the weight, as a share.
inline constexpr double kLoadError = 0.2;

/// @param measured  means of the load cells [N]  @param at_rest  those that were weighed; their sum is the weight [N]
/// @return forces on the wheels for the kernels: the measured ones, or those at rest when the cells are not to be believed:
///         not finite, negative, or their sum differs from the weight by more than kLoadError. Real-time safe
[[nodiscard]] inline PerWheel believed_load(const PerWheel& measured, const PerWheel& at_rest) noexcept {
  const auto sum = [](const PerWheel& load) { return std::accumulate(load.begin(), load.end(), 0.); };
  const double weight = sum(at_rest);
  const bool possible = std::ranges::all_of(measured, [](double N) { return std::isfinite(N) && N >= 0; });
  return possible && std::abs(sum(measured) - weight) <= kLoadError * weight ? measured : at_rest;
}

}  // namespace mrroc::edp
