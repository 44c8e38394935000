#include "edp/force_sensor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace mrroc::edp {

ForceSensor::ForceSensor(const ForceSensorParameters& parameters) noexcept : p_(parameters) {}

ForceSensor::Health ForceSensor::take(const Wrench& S_F_m, bool at_rest) noexcept {
  if (const Health health = judge(S_F_m); health != Health::good) return health;
  const auto length = static_cast<std::size_t>(p_.average);
  recent_[recent_count_ % length] = S_F_m;
  ++recent_count_;
  const std::size_t n = std::min(recent_count_, length);
  S_F_m_ = {};
  for (std::size_t k = 0; k < n; ++k) S_F_m_ += recent_[k];
  S_F_m_ *= 1. / static_cast<double>(n);

  if (!at_rest || !was_at_rest_) at_rest_count_ = 0;
  was_at_rest_ = at_rest;
  at_rest_[at_rest_count_ % at_rest_.size()] = S_F_m;
  ++at_rest_count_;
  return Health::good;
}

ForceSensor::Health ForceSensor::judge(const Wrench& S_F_m) noexcept {
  for (const Axis a : kAxes) {
    if (std::abs(S_F_m[a]) < p_.range[a]) continue;  // false for NaN
    complaint_ = {static_cast<int>(a), S_F_m[a], p_.range[a]};
    if (++bad_in_succession_ < p_.patience) return Health::skipped;
    return std::isfinite(S_F_m[a]) ? Health::saturated : Health::silent;
  }
  bad_in_succession_ = 0;
  return Health::good;
}

void ForceSensor::set_tool(double w, const Vector3& P) noexcept {
  p_.weight = w;
  p_.mass_centre = P;
}

void ForceSensor::bias(const Matrix3& R_0W) noexcept {
  const std::size_t n = std::min(at_rest_count_, at_rest_.size());
  if (n == 0) return;
  Wrench sum;
  for (std::size_t k = 0; k < n; ++k) sum += at_rest_[k];
  S_F_0_ = sum * (1. / static_cast<double>(n));
  W_F_r_ = -gravity(R_0W);
}

Wrench ForceSensor::gravity(const Matrix3& R_0W) const noexcept {
  const Vector3 f = -p_.weight * R_0W.row(2).transpose();
  return Wrench::from(f, p_.mass_centre.cross(f));
}

Wrench ForceSensor::adjusted(const Matrix3& R_0W) const noexcept {
  return -(xi_F(p_.T_WS, S_F_m_ - S_F_0_) - gravity(R_0W) - W_F_r_);
}

}  // namespace mrroc::edp
