#include "robots/rex/weighing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

/// @return whether the forces are those of cells that stand on the ground
bool possible(const PerWheel& load) noexcept {
  return std::all_of(load.begin(), load.end(), [](double N) { return std::isfinite(N) && N >= 0; });
}

double sum(const PerWheel& load) noexcept { return std::accumulate(load.begin(), load.end(), 0.0); }

Load empty() noexcept { return {kMass, {}, standing_load(kMass, {})}; }

}  // namespace

Load weigh(const PerWheel& load) noexcept {
  constexpr double kLightest = 0.5 * kMass;
  constexpr double kHeaviest = 4 * kMass;
  const double mass = sum(load) / kGravity;
  if (!possible(load) || mass < kLightest || mass > kHeaviest) return empty();
  PlanarPose centre;
  for (std::size_t i = 0; i < kWheels; ++i) {
    centre.x += kWheelX[i] * load[i] / (mass * kGravity);
    centre.y += kWheelY[i] * load[i] / (mass * kGravity);
  }
  if (std::abs(centre.x) > kHalfBase / 2 || std::abs(centre.y) > kHalfTrack / 2) return empty();
  return {mass, centre, load};
}

}  // namespace mrroc::rex
