// Friction of the ground at a place.
#pragma once
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// @param x, y  on M [m] @param time  simulated [s]
/// @return what the coefficients are multiplied by there and then
[[nodiscard]] constexpr double scale_at(const GroundParameters& ground, double x, double y, double time) {
  double scale = 1;
  for (const GroundPatch& p : ground.patches) {
    const bool outside = x < p.lower[0] || y < p.lower[1] || x > p.upper[0] || y > p.upper[1];
    if (time >= p.from && !outside) scale *= p.scale;
  }
  return scale;
}

/// @return coefficients of the wheels there and then
[[nodiscard]] constexpr Friction friction_at(const GroundParameters& ground, double x, double y,
                                             double time) {
  const double scale = scale_at(ground, x, y, time);
  return {.mu_x = ground.friction.mu_x * scale, .mu_y = ground.friction.mu_y * scale};
}

}  // namespace mrroc::sim
