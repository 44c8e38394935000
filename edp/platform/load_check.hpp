// Whether measured loads of a platform's wheels can be believed.
#pragma once
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/platform_command.hpp"

namespace mrroc::edp {

/// The sum of the load cells may differ so much from the weight, as a share.
inline constexpr double kLoadError = 0.2;

/// @param load    of the wheels [N]
/// @param weight  of the platform at rest [N]
/// @return whether wheels that stand on the ground can measure this: every load is finite and not negative, their sum is near
///         the weight. Real-time safe.
[[nodiscard]] inline bool is_credible(const PerWheel& load, double weight) noexcept {
  const bool possible = std::ranges::all_of(load, [](double N) { return std::isfinite(N) && N >= 0; });
  return possible && std::abs(std::accumulate(load.begin(), load.end(), -weight)) <= kLoadError * weight;
}

}  // namespace mrroc::edp
