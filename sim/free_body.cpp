#include "sim/free_body.hpp"

#include <cmath>

namespace mrroc::sim {

double resting_height(const FreeBodyParameters& p) {
  if (p.shape == FreeBodyShape::box) return p.size / 2;
  return std::sqrt(p.size * p.size - p.pedestal_opening * p.pedestal_opening) / 2;
}

}  // namespace mrroc::sim
