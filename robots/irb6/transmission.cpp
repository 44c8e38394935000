#include "robots/irb6/transmission.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::irb6 {
namespace {

using std::numbers::pi;

// Sine of an angle at the dead centre, and beyond: nothing that is divided by a slope becomes infinite.
constexpr double kDeadCentre = 1e-16;

double motor_at(const Drive& d, double output) { return d.gear * (output - d.theta0) + d.synchro; }
double output_at(const Drive& d, double motor) { return (motor - d.synchro) / d.gear + d.theta0; }

// Not finite stays not finite, so that it cannot pass for a position.
double clamp(double x, double low, double high, bool& inside) {
  if (!(x >= low && x <= high)) inside = false;
  return std::clamp(x, low, high);
}

}  // namespace

Transmission::Screw::Screw(const Linkage& k) noexcept
    : sl(k.sl),
      mi(k.mi),
      ni(k.ni),
      r(std::hypot(k.mi, k.ni)),
      phi(std::atan2(k.ni, k.mi)),
      l_min(std::sqrt(k.sl - r)),
      l_max(std::sqrt(k.sl + r)) {}

double Transmission::Screw::length(double theta, bool& inside) const noexcept {
  return std::sqrt(sl + r * std::cos(clamp(theta + phi, -pi, 0, inside)));
}

double Transmission::Screw::angle(double l, bool& inside) const noexcept {
  const double side = clamp(l, l_min, l_max, inside);
  return -std::acos(std::clamp((side * side - sl) / r, -1., 1.)) - phi;
}

Direction Transmission::Screw::direction(double l) const noexcept {
  const double side = std::clamp(l, l_min, l_max);
  const double c = std::clamp((side * side - sl) / r, -1., 1.);  // of theta + phi, whose sine is negative
  const double s = -std::sqrt(1 - c * c);
  return {(c * mi + s * ni) / r, (s * mi - c * ni) / r};
}

double Transmission::Screw::slope(Direction theta) const noexcept {
  const auto [c, s] = theta;
  return std::max(-(mi * s + ni * c), kDeadCentre * r) / (2 * std::sqrt(sl + mi * c - ni * s));
}

Transmission::Transmission(const ArmParameters& arm) noexcept
    : first_(arm.first()), count_(arm.axis_count()), lower_(arm.lower_arm), upper_(arm.upper_arm) {
  for (std::size_t k = 0; k < drive_.size(); ++k) drive_[k] = arm.axes[k].drive;
}

Converted Transmission::motors(const AxisVector& joints) const noexcept {
  Converted m{AxisVector(count_), joints.allFinite()};
  const Drive* d = &drive_[static_cast<std::size_t>(first_)];
  const double* q = joints.data() + first_;
  double* out = m.value.data() + first_;

  const double theta3 = q[1] + q[2] + pi / 2;
  const double theta4 = theta3 + q[3];
  if (first_ == 1) m.value[0] = motor_at(drive_[0], joints[0]);
  out[0] = motor_at(d[0], q[0]);
  out[1] = motor_at(d[1], lower_.length(q[1], m.inside));
  out[2] = motor_at(d[2], upper_.length(theta3, m.inside));
  out[3] = motor_at(d[3], theta4);
  out[4] = motor_at(d[4], q[4]) + (out[3] - d[3].synchro);
  out[5] = motor_at(d[5], q[5]);
  return m;
}

Converted Transmission::joints(const AxisVector& motors) const noexcept {
  Converted q{AxisVector(count_), motors.allFinite()};
  const Drive* d = &drive_[static_cast<std::size_t>(first_)];
  const double* m = motors.data() + first_;
  double* out = q.value.data() + first_;

  const double theta2 = lower_.angle(output_at(d[1], m[1]), q.inside);
  const double theta3 = upper_.angle(output_at(d[2], m[2]), q.inside);
  const double theta4 = output_at(d[3], m[3]);
  if (first_ == 1) q.value[0] = output_at(drive_[0], motors[0]);
  out[0] = output_at(d[0], m[0]);
  out[1] = theta2;
  out[2] = theta3 - theta2 - pi / 2;
  out[3] = theta4 - theta3;
  out[4] = output_at(d[4], m[4] - (m[3] - d[3].synchro));
  out[5] = output_at(d[5], m[5]);
  return q;
}

Pitches Transmission::pitches(const AxisVector& motors) const noexcept {
  const Drive* d = &drive_[static_cast<std::size_t>(first_)];
  const double* m = motors.data() + first_;
  return {.theta2 = lower_.direction(output_at(d[1], m[1])),
          .theta3 = upper_.direction(output_at(d[2], m[2])),
          .theta4 = Direction::of(output_at(d[3], m[3])),
          .q5 = Direction::of(output_at(d[4], m[4] - (m[3] - d[3].synchro)))};
}

Directions Transmission::directions(const AxisVector& motors) const noexcept {
  const Drive* d = &drive_[static_cast<std::size_t>(first_)];
  const double* m = motors.data() + first_;
  return {pitches(motors), Direction::of(output_at(d[0], m[0])), Direction::of(output_at(d[5], m[5])),
          first_ == 1 ? output_at(drive_[0], motors[0]) : 0};
}

double Transmission::lower_arm_gear(Direction theta2) const noexcept {
  return drive_[static_cast<std::size_t>(first_) + 1].gear * lower_.slope(theta2);
}

double Transmission::upper_arm_gear(Direction theta3) const noexcept {
  return drive_[static_cast<std::size_t>(first_) + 2].gear * upper_.slope(theta3);
}

AxisMatrix Transmission::jacobian(const AxisVector& joints) const noexcept {
  AxisMatrix J = AxisMatrix::Zero(count_, count_);
  const Drive* d = &drive_[static_cast<std::size_t>(first_)];
  const double* q = joints.data() + first_;
  const int k = first_;

  const double theta3 = q[1] + q[2] + pi / 2;
  const double upper = upper_arm_gear(Direction::of(theta3));
  if (first_ == 1) J(0, 0) = drive_[0].gear;
  J(k, k) = d[0].gear;
  J(k + 1, k + 1) = lower_arm_gear(Direction::of(q[1]));
  J(k + 2, k + 1) = J(k + 2, k + 2) = upper;
  J(k + 3, k + 1) = J(k + 3, k + 2) = J(k + 3, k + 3) = d[3].gear;
  J.row(k + 4) = J.row(k + 3);
  J(k + 4, k + 4) = d[4].gear;
  J(k + 5, k + 5) = d[5].gear;
  return J;
}

}  // namespace mrroc::irb6
