#include "edp/platform/reference_offset.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::edp {

PlanarPose ReferenceOffset::nearer(const PlanarPose& p, double time) const noexcept {
  const PlanarPose there = chained(offset_, p);
  const double away = distance(p, there);
  const double share = away > 0 ? std::max(0.0, 1 - time * kBack / away) : 0;
  const double most = time * kTurnedBack;
  const double turn = offset_.phi - std::clamp(offset_.phi, -most, most);
  const double c = std::cos(turn), s = std::sin(turn);
  return {p.x + share * (there.x - p.x) - (c * p.x - s * p.y),
          p.y + share * (there.y - p.y) - (s * p.x + c * p.y), turn};
}

Reference ReferenceOffset::applied(Reference reference, double period) const noexcept {
  for (std::size_t k = 0; k < reference.size(); ++k) {
    PathPoint& point = reference[k];
    point.p = chained(nearer(point.p, static_cast<double>(k) * period), point.p);
  }
  return reference;
}

}  // namespace mrroc::edp
