#include "robots/rex/stage_window.hpp"

#include <algorithm>
#include <cmath>

#include "edp/platform/wheel_load.hpp"
#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

using Wheels = Eigen::Vector4d;

constexpr double kStepPeriod = kPlatformPeriod / kPlatformSteps;

Wheels vector_of(const PerWheel& wheels) noexcept { return Eigen::Map<const Wheels>(wheels.data()); }

/// @return whether all numbers are finite and of at most that size
bool possible(const Wheels& values, double most) noexcept {
  return values.allFinite() && values.cwiseAbs().maxCoeff() <= most;
}

/// @return steps from one to another that is not before it, without overflow
std::uint64_t steps_between(std::int64_t from, std::int64_t to) noexcept {
  return static_cast<std::uint64_t>(to) - static_cast<std::uint64_t>(from);
}

}  // namespace

void StageWindow::begin(const edp::StandingStill& found) noexcept {
  weighed_ = weigh(found.load);
  yaw_offset_ = std::isfinite(found.yaw_offset) ? wrap_angle(found.yaw_offset) : 0;
  gyro_bias_ = std::isfinite(found.gyro_bias) ? found.gyro_bias : 0;
  map_step_ = found.step;
  size_ = 0;
  stage_[0] = stage_of({.step = found.step, .theta = found.theta, .load = found.load});
  size_ = 1;
}

Entry StageWindow::add(const edp::StageReading& reading) noexcept {
  if (size_ == 0 || reading.step <= newest().step) return Entry::repeated;
  const bool follows =
      steps_between(newest().step, reading.step) == static_cast<std::uint64_t>(kPlatformSteps);
  const WindowStage stage = stage_of(reading);
  if (!follows) size_ = 0;
  if (full()) {
    std::move(stage_.begin() + 1, stage_.end(), stage_.begin());
    --size_;
  }
  stage_[static_cast<std::size_t>(size_++)] = stage;
  return follows ? Entry::next : Entry::restart;
}

WindowStage StageWindow::stage_of(const edp::StageReading& reading) const noexcept {
  constexpr double kMostTorque = 10 * kMaxTorque;
  constexpr double kMostSpeed = 4 * kMaxWheelSpeed;
  constexpr double kMostYawRate = 50;  // [rad/s]
  WindowStage stage;
  stage.step = reading.step;
  stage.torque = vector_of(reading.torque);
  stage.torque_known = reading.enabled && possible(stage.torque, kMostTorque);
  if (!possible(stage.torque, kMostTorque)) stage.torque.setZero();
  stage.load = vector_of(edp::believed_load(reading.load, weighed_.wheel));
  stage.theta = vector_of(reading.theta);
  if (!stage.theta.allFinite()) stage.theta = size_ > 0 ? newest().theta : Wheels::Zero();
  stage.wheel_speed = vector_of(reading.theta_dot);
  stage.wheels_valid = possible(stage.wheel_speed, kMostSpeed);
  stage.yaw = reading.yaw;
  stage.yaw_rate = reading.yaw_rate - gyro_bias_;
  stage.imu_valid =
      reading.imu_valid && std::isfinite(reading.yaw) && std::abs(stage.yaw_rate) < kMostYawRate;
  return stage;
}

int StageWindow::add(const MapPose& pose) noexcept {
  if (!pose.valid || size_ == 0 || pose.step < stage_[0].step || pose.step > newest().step) return -1;
  const PlanarFactor factor = planar_factor({pose.p.x, pose.p.y, pose.p.phi},
                                            Eigen::Map<const Eigen::Matrix3d>(pose.covariance.data()),
                                            {noise_.map_position, noise_.map_position, noise_.map_heading});
  if (!factor.valid) return -1;
  const auto after_oldest = static_cast<int>(steps_between(stage_[0].step, pose.step));
  const int k = (after_oldest + kPlatformSteps / 2) / kPlatformSteps;
  const int nearest = std::min(k, size_ - 1);
  WindowStage& stage = stage_[static_cast<std::size_t>(nearest)];
  stage.map = factor;
  stage.map_delay = (after_oldest - nearest * kPlatformSteps) * kStepPeriod;
  map_step_ = std::max(map_step_, pose.step);
  constexpr double kMapGain = 0.02;
  anchor_yaw(stage, pose.p.phi, kMapGain);
  return nearest;
}

void StageWindow::see_heading(int k, double heading) noexcept {
  constexpr std::uint64_t kWithoutMap = 500;  // [steps]
  constexpr double kExact = 3e-4;             // of a turn from pair to pair [rad]
  constexpr double kGain = 0.1;
  const WindowStage& stage = (*this)[k];
  if (odometry_heading_ > kExact || stage.step < map_step_ || !std::isfinite(heading)) return;
  if (steps_between(map_step_, stage.step) > kWithoutMap) anchor_yaw(stage, heading, kGain);
}

void StageWindow::anchor_yaw(const WindowStage& stage, double heading, double gain) noexcept {
  constexpr double kMost = 0.1;  // of a difference [rad]
  if (!stage.imu_valid) return;
  const double then = stage.yaw + stage.map_delay * stage.yaw_rate;
  yaw_offset_ += gain * std::clamp(wrap_angle(heading - (then + yaw_offset_)), -kMost, kMost);
}

void StageWindow::displace(double turn) noexcept {
  for (int i = 0; i < size_; ++i) stage_[static_cast<std::size_t>(i)].map.valid = false;
  yaw_offset_ = wrap_angle(yaw_offset_ + turn);
}

int StageWindow::add(const OdometryReading& odometry) noexcept {
  const int first = find(odometry.step_before);
  const int second = find(odometry.step);
  if (!odometry.valid || first < 0 || second <= first || !can_be_picture(first, second)) return -1;
  constexpr std::array<int, 3> kPlanar{0, 1, 5};  // x, y, and the turn about z
  const auto& A = odometry.A;
  const Eigen::Map<const Eigen::Matrix<double, 6, 6>> covariance(odometry.covariance.data());
  const double least = std::hypot(noise_.odometry_position, noise_.odometry_scale * std::hypot(A[3], A[7]));
  const PlanarFactor factor =
      planar_factor({A[3], A[7], std::atan2(A[4], A[0])}, covariance(kPlanar, kPlanar),
                    {least, least, noise_.odometry_heading});
  if (!factor.valid) return -1;
  WindowStage& stage = stage_[static_cast<std::size_t>(second)];
  stage.odometry = factor;
  stage.step_before = odometry.step_before;
  odometry_heading_ = std::sqrt(factor.covariance(2, 2));
  stage_[static_cast<std::size_t>(first)].picture = true;
  return first;
}

int StageWindow::find(std::int64_t step) const noexcept {
  for (int k = 0; k < size_; ++k)
    if ((*this)[k].step == step) return k;
  return -1;
}

// There is one clone: a picture must not take away that of another motion which reaches over it.
bool StageWindow::can_be_picture(int first, int second) const noexcept {
  for (int k = first + 1; k < second; ++k)
    if ((*this)[k].picture) return false;
  for (int k = first + 1; k < size_; ++k)
    if ((*this)[k].odometry.valid && (*this)[k].step_before < (*this)[first].step) return false;
  return true;
}

}  // namespace mrroc::rex
