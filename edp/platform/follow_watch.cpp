#include "edp/platform/follow_watch.hpp"

#include <cmath>

#include "edp/guard.hpp"

namespace mrroc::edp {

std::optional<Fault> FollowWatch::step(const Reference& reference, const PlanarPose& p) noexcept {
  const PlanarPose& wanted = reference.front().p;
  const double away = std::hypot(p.x - wanted.x, p.y - wanted.y);
  far_ = away > kMostAway ? far_ + 1 : 0;
  if (far_ < kLong) return {};
  return make_fault(FaultCode::estimate_lost, "distance from where the platform is to be [m]", -1, away,
                    kMostAway);
}

}  // namespace mrroc::edp
