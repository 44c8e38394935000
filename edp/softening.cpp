#include "edp/softening.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::edp {
namespace {

constexpr double kSofter = 0.5;     // factor of a share by which it falls
constexpr double kRecovery = 1;     // time in which it doubles without contact [s]
constexpr double kEarlier = 0.5;    // swings over those that are a fault
constexpr double kSustained = 0.9;  // factor from period to period of swings that do not die away
constexpr double kTouches = 0.5;    // force that is a contact, over such swings

OscillationParameters earlier(OscillationParameters p) noexcept {
  p.force *= kEarlier;
  p.torque *= kEarlier;
  p.growth = 1;
  p.sustained = std::min(p.sustained, kSustained);
  p.periods = 2;
  return p;
}

}  // namespace

Softening::Softening(const OscillationParameters& p, double dt) noexcept
    : early_(earlier(p)), observer_(early_, dt), softest_(p.softest), recovery_(std::exp2(dt / kRecovery)) {
  shares_.fill(1);
}

AxisSet Softening::step(const Wrench& F_a, AxisSet watched) noexcept {
  AxisSet softened = observer_.swinging(F_a, watched);
  for (std::size_t axis = 0; axis < shares_.size(); ++axis) {
    double& share = shares_[axis];
    softened[axis] = softened[axis] && kSofter * share >= softest_;
    const double touches = kTouches * (axis < 3 ? early_.force : early_.torque);
    if (!watched[axis])
      share = 1;
    else if (softened[axis])
      share *= kSofter;
    else if (std::abs(F_a.v[axis]) < touches)
      share = std::min(recovery_ * share, 1.);
  }
  observer_.forget(softened);
  return softened;
}

}  // namespace mrroc::edp
