#include "edp/platform/synchronisation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "edp/guard.hpp"

namespace mrroc::edp {

PlatformSynchronisation::PlatformSynchronisation(const PlatformDriverParameters& parameters,
                                                 double dt) noexcept
    : rest_steps_(static_cast<int>(std::lround(parameters.synchro_rest / dt))),
      timeout_steps_(static_cast<int>(std::lround(parameters.synchro_timeout / dt))) {}

void PlatformSynchronisation::start() noexcept {
  steps_ = standing_ = 0;
  forget_poses();
}

void PlatformSynchronisation::stand_anew(const StageCollector& sensors) noexcept {
  standing_ = 0;
  stands_since_ = sensors.reading().step;
  away_ = load_sum_ = {};
  yaw_rate_sum_ = 0;
  yaw_rates_ = loads_ = 0;
  forget_poses();
}

void PlatformSynchronisation::step(const StageCollector& sensors) noexcept {
  ++steps_;
  double farthest = 0;
  for (std::size_t k = 0; k < kWheels; ++k) {
    away_[k] += sensors.wheels().increments()[k];
    farthest = std::max(farthest, std::abs(away_[k]));
  }
  if (standing_ == 0 || farthest > kPlay) stand_anew(sensors);
  ++standing_;
  if (standing_ <= kResetSteps || measured()) return;
  const PlatformReading& reading = sensors.reading();
  if (reading.imu_valid) {
    yaw_rate_sum_ += reading.yaw_rate;
    ++yaw_rates_;
  }
  if (!reading.load_valid) return;
  for (std::size_t k = 0; k < kWheels; ++k) load_sum_[k] += reading.load[k];
  ++loads_;
}

void PlatformSynchronisation::add(const MapPose& pose) noexcept {
  if (standing_ == 0 || pose.step < stands_since_) return;
  const PlanarPose away{pose.p.x - first_.x, pose.p.y - first_.y, wrap_angle(pose.p.phi - first_.phi)};
  if (poses_ == 0 || std::hypot(away.x, away.y) > kAgree || std::abs(away.phi) > kAgree) {
    first_ = pose.p;
    sum_ = {};
    covariance_sum_ = pose.covariance;
    poses_ = 1;
    return;
  }
  sum_ = {sum_.x + away.x, sum_.y + away.y, sum_.phi + away.phi};
  for (std::size_t k = 0; k < covariance_sum_.size(); ++k) covariance_sum_[k] += pose.covariance[k];
  ++poses_;
}

std::optional<StandingStill> PlatformSynchronisation::found(const StageCollector& sensors,
                                                            std::int64_t step) const noexcept {
  const PlatformReading& reading = sensors.reading();
  if (!measured() || poses_ < kPoses || failed() || !reading.imu_valid) return std::nullopt;
  StandingStill result;
  result.step = step;
  result.p = {first_.x + sum_.x / poses_, first_.y + sum_.y / poses_,
              wrap_angle(first_.phi + sum_.phi / poses_)};
  for (std::size_t k = 0; k < covariance_sum_.size(); ++k)
    result.covariance[k] = covariance_sum_[k] / (poses_ * poses_);
  result.yaw_offset = wrap_angle(result.p.phi - reading.yaw);
  result.gyro_bias = yaw_rate_sum_ / yaw_rates_;
  for (std::size_t k = 0; k < kWheels; ++k) result.load[k] = load_sum_[k] / loads_;
  result.theta = sensors.wheels().theta();
  return result;
}

std::optional<Fault> PlatformSynchronisation::failed() const noexcept {
  if (measured()) {
    const int enough = rest_steps_ / 2;
    if (yaw_rates_ < enough)
      return make_fault(FaultCode::sensor_silent, "readings of the IMU", -1, yaw_rates_, enough);
    if (loads_ < enough)
      return make_fault(FaultCode::sensor_silent, "readings of the load cells", -1, loads_, enough);
    for (std::size_t k = 0; k < kWheels; ++k)
      if (!(load_sum_[k] > 0))
        return make_fault(FaultCode::sensor_silent, "load of a wheel at rest [N]", static_cast<int>(k),
                          load_sum_[k] / loads_);
  }
  if (steps_ < timeout_steps_) return std::nullopt;
  return measured() ? make_fault(FaultCode::position_unknown, "positions that agree", -1, poses_, kPoses)
                    : make_fault(FaultCode::position_unknown, "steps at rest", -1, standing_, rest_steps_);
}

}  // namespace mrroc::edp
