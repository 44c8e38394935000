#include "robots/rex/kinematic_tracker.hpp"

#include <algorithm>
#include <cmath>

#include "robots/rex/wheels.hpp"

namespace mrroc::rex {
namespace {

// Of the law; found by trying on a figure eight.
constexpr double k_x = 2;       // [1/s]
constexpr double k_y = 10;      // [1/m^2]
constexpr double k_phi = 3;     // [1/m]
constexpr double k_turn = 1.5;  // [1/s]
// A platform that is turned by skidding turns about so much less than its wheels roll.
constexpr double kSkidding = 2.1;
// Of the regulators of speed.
constexpr double kProportional = 3;  // [N m s/rad]
constexpr double kIntegral = 25;     // [N m/rad]

struct Twist2 {
  double v, w;
};

Twist2 law(const PlanarPose& p, const PathPoint& wanted) noexcept {
  const double c = std::cos(p.phi);
  const double s = std::sin(p.phi);
  const double dx = wanted.p.x - p.x;
  const double dy = wanted.p.y - p.y;
  const double e_x = c * dx + s * dy;
  const double e_y = -s * dx + c * dy;
  const double e_phi = wrap_angle(wanted.p.phi - p.phi);
  return {wanted.v * std::cos(e_phi) + k_x * e_x,
          wanted.w + wanted.v * (k_y * e_y + k_phi * std::sin(e_phi)) + k_turn * e_phi};
}

}  // namespace

void KinematicTracker::begin(const edp::EstimatorResult& /*x*/) noexcept { integral_ = {}; }

edp::TrackerResult KinematicTracker::step(const edp::EstimatorResult& x, const Slip& /*slip*/,
                                          const PerWheel& /*load*/,
                                          std::span<const PathPoint, kHorizonPoints> reference) noexcept {
  edp::TrackerResult r;
  const Twist2 twist = law(x.estimate.p, reference[0]);
  const PerWheel wanted = rolling_speeds(twist.v, kSkidding * twist.w);
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double error = wanted[i] - x.estimate.theta_dot[i];
    const TorqueRange range = torque_range(x.estimate.theta_dot[i]);
    const double integral = integral_[i] + error * kPlatformPeriod;
    const double torque = kProportional * error + kIntegral * integral;
    if (!std::isfinite(torque)) {
      r.health.solver_failed = true;
      continue;
    }
    r.torque[i] = std::clamp(torque, range.lower, range.upper);
    // At a limit it does not grow any further.
    if (r.torque[i] == torque || std::abs(integral) < std::abs(integral_[i])) integral_[i] = integral;
  }
  for (std::size_t k = 0; k < kHorizonPoints; ++k) r.horizon[k] = reference[k].p;
  r.torques.fill(r.torque);
  return r;
}

}  // namespace mrroc::rex
