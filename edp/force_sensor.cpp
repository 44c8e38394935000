#include "edp/force_sensor.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "edp/guard.hpp"

namespace mrroc::edp {

ForceSensor::ForceSensor(const ForceSensorParameters& parameters, double dt) noexcept
    : p_(parameters),
      weight_of_new_(p_.low_pass > 0 ? -std::expm1(-2 * std::numbers::pi * p_.low_pass * dt) : 1) {}

ForceSensor::Health ForceSensor::take(const Wrench& S_F_m, bool at_rest) noexcept {
  if (const Health health = judge(S_F_m); health != Health::good) return health;
  const bool first = recent_count_ == 0;
  const Wrench mean = mean_with(S_F_m);
  S_F_m_ += (first ? 1 : weight_of_new_) * (mean - S_F_m_);

  if (!at_rest || !was_at_rest_) at_rest_count_ = 0;
  was_at_rest_ = at_rest;
  at_rest_[at_rest_count_ % at_rest_.size()] = S_F_m;
  ++at_rest_count_;
  return Health::good;
}

Wrench ForceSensor::mean_with(const Wrench& S_F_m) noexcept {
  const auto length = static_cast<std::size_t>(p_.average);
  recent_[recent_count_ % length] = S_F_m;
  ++recent_count_;
  const std::size_t n = std::min(recent_count_, length);
  Wrench mean;
  for (std::size_t k = 0; k < n; ++k) mean += recent_[k];
  return mean * (1. / static_cast<double>(n));
}

ForceSensor::Health ForceSensor::judge(const Wrench& S_F_m) noexcept {
  const auto is_nan = [](double x) { return std::isnan(x); };
  if (std::ranges::all_of(S_F_m.v, is_nan)) return count_bad(Health::silent, {-1, S_F_m.v[0], 0});
  for (const Axis a : kAxes) {
    if (std::abs(S_F_m[a]) < p_.range[a]) continue;  // false for NaN
    const Health health = std::isfinite(S_F_m[a]) ? Health::saturated : Health::not_finite;
    return count_bad(health, {static_cast<int>(a), S_F_m[a], p_.range[a]});
  }
  bad_in_succession_ = 0;
  return stuck(S_F_m) ? Health::stuck : Health::good;
}

ForceSensor::Health ForceSensor::count_bad(Health health, const SensorDiagnostic& diagnostic) noexcept {
  diagnostic_ = diagnostic;
  if (bad_in_succession_ < p_.fault_after) ++bad_in_succession_;
  return bad_in_succession_ < p_.fault_after ? Health::skipped : health;
}

bool ForceSensor::stuck(const Wrench& S_F_m) noexcept {
  if (p_.stuck_after == 0) return false;
  bool found = false;
  for (const Axis a : kAxes) {
    int& unchanged = unchanged_[static_cast<std::size_t>(a)];
    unchanged = S_F_m[a] == last_[a] ? std::min(unchanged + 1, p_.stuck_after) : 0;
    if (found || unchanged < p_.stuck_after) continue;
    found = true;
    diagnostic_ = {static_cast<int>(a), S_F_m[a], static_cast<double>(p_.stuck_after)};
  }
  last_ = S_F_m;
  return found;
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

std::optional<Fault> sensor_fault(ForceSensor::Health health, const SensorDiagnostic& diagnostic) noexcept {
  using Health = ForceSensor::Health;
  const auto fault = [&](FaultCode code, std::string_view text) {
    return make_fault(code, text, diagnostic.component, diagnostic.value, diagnostic.limit);
  };
  switch (health) {
    case Health::good:
    case Health::skipped:
      break;
    case Health::silent:
      return make_fault(FaultCode::sensor_silent, "force sensor");
    case Health::not_finite:
      return fault(FaultCode::force_not_finite, "component of the reading");
    case Health::saturated:
      return fault(FaultCode::force_saturated, "component of the reading [N], [N m]");
    case Health::stuck:
      return fault(FaultCode::force_stuck, "component of the reading [N], [N m]; limit: equal readings");
  }
  return {};
}

}  // namespace mrroc::edp
