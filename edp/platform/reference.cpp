#include "edp/platform/reference.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::edp {

Reference reference_ahead(const FragmentQueue& queue, const Pace& pace, double period) noexcept {
  Reference reference;
  for (std::size_t k = 0; k < reference.size(); ++k) {
    const double ahead = static_cast<double>(k) * period / kPlatformPeriod;
    PathPoint& point = reference[k] = queue.at(pace.passes(ahead));
    const double now = pace.after(ahead);
    point.v *= now;
    point.w *= now;
  }
  return reference;
}

Reference drawn_near(Reference reference, const PlanarPose& p) noexcept {
  const PlanarPose& first = reference.front().p;
  const double dx = p.x - first.x;
  const double dy = p.y - first.y;
  const double away = std::hypot(dx, dy);
  const double share = away > kMostAway ? 1 - kMostAway / away : 0;
  const double turned = wrap_angle(first.phi - p.phi);
  const double back = std::clamp(turned, -kMostTurnedAway, kMostTurnedAway) - turned;
  for (PathPoint& point : reference) {
    point.p.x += share * dx;
    point.p.y += share * dy;
    point.p.phi += back;
  }
  return reference;
}

}  // namespace mrroc::edp
