#include "edp/compensating_regulator.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "edp/regulator.hpp"

namespace mrroc::edp {
namespace {

/// Share of the difference from the regulator before that is left after a step.
constexpr double kFade = 0.9;

/// Share of the largest current that the regulator may ask for.
constexpr double kCurrentShare = 0.8;

}  // namespace

CompensatingRegulator::CompensatingRegulator(const CompensationCoefficients& c, const DriveModel& drive,
                                             double increments_per_rad, double dt) {
  const double steps = drive.time_constant() / dt;
  alpha_ = std::exp(-1 / steps);
  beta_ = steps * (1 - alpha_);
  gain_ = drive.speed_per_pwm() * increments_per_rad * dt;
  per_gain_ = 1 / gain_;
  per_rise_ = 1 / ((1 - alpha_) * gain_);
  torque_scale_ = drive.pwm_per_torque();
  per_presliding_ = 1 / (drive.presliding * increments_per_rad);
  stiffness_ = drive.friction * torque_scale_ * per_presliding_;
  max_pull_ = std::min(kCurrentShare * drive.max_current, drive.current_limit) * drive.resistance *
              kPwmScale / drive.supply;

  // Ackermann's formula for both: K = [0 1] [B AB]^-1 (A - z)^2, L = A^-1 (A - z)^3 [C; CA; CA^2]^-1 [0 0 1]'.
  const Eigen::Vector2d B((1 - beta_) * gain_, (1 - alpha_) * gain_);
  Eigen::Matrix2d A;
  A << 1, beta_, 0, alpha_;
  Eigen::Matrix2d reach;
  reach << B, A * B;
  const Eigen::Matrix2d off = A - std::exp(-c.bandwidth * dt) * Eigen::Matrix2d::Identity();
  const Eigen::RowVector2d K = reach.inverse().row(1) * off * off;
  k_p_ = K[0];
  k_v_ = K[1];

  Eigen::Matrix3d A3;
  A3 << A, B, 0, 0, 1;
  Eigen::Matrix3d seen;
  seen << 1, 0, 0, A3.row(0), A3.row(0) * A3;
  const Eigen::Matrix3d off3 = A3 - std::exp(-c.observer * dt) * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d L = A3.inverse() * off3 * off3 * off3 * seen.inverse().col(2);
  l_p_ = L[0];
  l_v_ = L[1];
  l_d_ = L[2];
}

double CompensatingRegulator::step(double set_increment, double error, double gravity_feed_forward) noexcept {
  if (restarted_) {
    p_ = -error;
    v_ = r_ = 0;
    restarted_ = false;
  }
  const double surprise = -error - p_;
  p_ += l_p_ * surprise;
  v_ += l_v_ * surprise;
  d_ += l_d_ * surprise;

  deflection_ = (deflection_ + set_increment) / (1 + std::abs(set_increment) * per_presliding_);
  const double known = gravity_feed_forward * torque_scale_ + stiffness_ * deflection_;
  if (join_ == Join::with_its_load) d_ = known + r_ * per_gain_ - joined_pwm_;

  const double wanted =
      (set_increment - alpha_ * r_) * per_rise_ + k_p_ * (-r_ / 2 - p_) + k_v_ * (r_ - v_) - d_ + known;
  if (join_ != Join::none) bump_ = joined_pwm_ - wanted;
  join_ = Join::none;

  const double idle = v_ * per_gain_;  // without current
  const double free_pull = wanted + bump_ - idle;
  const double pull = std::clamp(free_pull, -max_pull_, max_pull_);
  at_limit_ = pull != free_pull;
  const double u = std::clamp(idle + pull, -kMaxPwm, kMaxPwm);
  bump_ *= kFade;

  const double driving = gain_ * (u - known + d_);
  p_ += beta_ * v_ + (1 - beta_) * driving - set_increment;
  v_ = alpha_ * v_ + (1 - alpha_) * driving;
  r_ = set_increment;
  return u;
}

void CompensatingRegulator::resume(double set_increment, double error, double pwm) noexcept {
  p_ = set_increment - error;  // when the next step begins
  v_ = r_ = set_increment;
  deflection_ = 0;
  joined_pwm_ = pwm;
  restarted_ = false;
  join_ = Join::with_its_load;
}

void CompensatingRegulator::resume(const CompensatingRegulator& other, double pwm) noexcept {
  p_ = other.p_;
  v_ = other.v_;
  d_ = other.d_;
  r_ = other.r_;
  deflection_ = other.deflection_;
  joined_pwm_ = pwm;
  restarted_ = other.restarted_;
  join_ = Join::without;
}

void CompensatingRegulator::restart() noexcept {
  restarted_ = true;
  at_limit_ = false;
  bump_ = 0;
}

void CompensatingRegulator::reset() noexcept {
  p_ = v_ = d_ = r_ = deflection_ = 0;
  join_ = Join::none;
  restart();
}

}  // namespace mrroc::edp
