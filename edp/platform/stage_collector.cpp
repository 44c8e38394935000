#include "edp/platform/stage_collector.hpp"

#include <algorithm>
#include <cmath>

#include "edp/platform/wheel_load.hpp"

namespace mrroc::edp {
namespace {

bool is_finite(const PerWheel& numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

PerWheel mean(const PerWheel& total, int n) {
  PerWheel result{};
  for (std::size_t k = 0; n > 0 && k < kWheels; ++k) result[k] = total[k] / n;
  return result;
}

void add(PerWheel& total, const PerWheel& numbers) {
  for (std::size_t k = 0; k < kWheels; ++k) total[k] += numbers[k];
}

}  // namespace

void StageCollector::measure(const PlatformReading& reading) noexcept {
  reading_ = reading;
  reading_.imu_valid = reading.imu_valid && std::isfinite(reading.yaw) && std::isfinite(reading.yaw_rate);
  reading_.load_valid = reading.load_valid && is_finite(reading.load);
  wheels_.step(reading);
  imu_absent_ = reading_.imu_valid ? 0 : std::min(imu_absent_ + 1, kImuSilent);
  if (!reading_.load_valid) return;
  add(load_sum_, reading_.load);
  ++loads_;
}

void StageCollector::command(const PlatformDrive& drive) noexcept {
  ++commands_;
  if (drive.enabled) return add(torque_sum_, drive.torque);
  braked_ = true;
  const PerWheel speed = wheels_.theta_dot();
  for (std::size_t k = 0; k < kWheels; ++k)
    torque_sum_[k] += std::clamp(-platform_->brake * speed[k], -platform_->max_torque, platform_->max_torque);
}

PerWheel StageCollector::weigh() noexcept {
  const PerWheel told = mean(load_sum_, loads_);
  told_load_.reset();
  if (loads_ > 0) told_load_ = told;
  loads_wrong_ = is_believed(told, static_load_) ? 0 : std::min(loads_wrong_ + 1, kLoadsWrong);
  return believed_load(told, static_load_);
}

StageReading StageCollector::take(std::int64_t step) noexcept {
  StageReading stage;
  stage.step = step;
  stage.theta = wheels_.theta();
  stage.theta_dot = wheels_.theta_dot();
  stage.imu_valid = reading_.imu_valid;
  stage.yaw = reading_.imu_valid ? reading_.yaw : 0;
  stage.yaw_rate = reading_.imu_valid ? reading_.yaw_rate : 0;
  stage.load = weigh();
  stage.torque = mean(torque_sum_, commands_);
  stage.enabled = !braked_;
  load_sum_ = torque_sum_ = {};
  loads_ = commands_ = 0;
  braked_ = false;
  return stage;
}

}  // namespace mrroc::edp
