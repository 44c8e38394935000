// Friction of the ground at a place.
#pragma once
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// @param x, y  on M [m] @param time  simulated [s]
/// @return coefficients there and then
[[nodiscard]] constexpr Friction friction_at(const GroundParameters& ground, double x, double y,
                                             double time) {
  Friction f = ground.friction;
  for (const GroundPatch& p : ground.patches) {
    if (time < p.from || x < p.lower[0] || y < p.lower[1] || x > p.upper[0] || y > p.upper[1]) continue;
    f.mu_x *= p.scale;
    f.mu_y *= p.scale;
  }
  return f;
}

}  // namespace mrroc::sim
