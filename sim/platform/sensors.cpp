#include "sim/platform/sensors.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace mrroc::sim {
namespace {

constexpr double kWrongLoad = 2;  // that a broken cell shows, as a share of the true one

std::array<Encoder, kWheels> encoders(double increments_per_turn, std::mt19937_64& random) {
  std::uniform_real_distribution<double> phase(0, 1);
  const double per_rad = increments_per_turn / (2 * std::numbers::pi);
  // Braces are evaluated from the left to the right.
  return {Encoder(per_rad, phase(random)), Encoder(per_rad, phase(random)), Encoder(per_rad, phase(random)),
          Encoder(per_rad, phase(random))};
}

}  // namespace

PlatformSensors::PlatformSensors(const PlatformParameters& platform, std::uint64_t seed, double dt)
    : k_(platform), dt_(dt), random_(seed), encoder_(encoders(platform.body.increments_per_turn, random_)) {
  std::uniform_real_distribution<double> offset(-1, 1);
  bias_ = k_.imu.bias * offset(random_);
  for (double& each : load_bias_) each = k_.load_cells.bias * offset(random_);
}

PlatformReading PlatformSensors::measure(std::int64_t step, const PlatformMotion& motion, bool imu_reset) {
  PlatformReading r;
  r.step = step;
  count(motion, r);
  measure_turn(motion.turn, imu_reset, r);
  weigh(motion.load, r);
  for (std::size_t i = 0; i < kWheels; ++i) r.current[i] = motion.torque[i] / k_.body.torque_constant;
  return r;
}

void PlatformSensors::count(const PlatformMotion& motion, PlatformReading& r) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    const std::int32_t count = encoder_[i].count(motion.turned[i]);
    if (static_cast<int>(i) == k_.faults.wheel && k_.faults.encoder_stuck.contains(r.step))
      lost_[i] += count - counted_[i];
    counted_[i] = count;
    r.encoder[i] = count - lost_[i];
  }
}

/// The yaw is the sum of what the IMU believes of the rate, also while it says nothing.
void PlatformSensors::measure_turn(double turn, bool reset, PlatformReading& r) {
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  const double rate = turn / dt_ + bias_ + k_.imu.noise * normal_(random_);
  bias_ += k_.imu.bias_walk * std::sqrt(dt_) * normal_(random_);
  yaw_ = reset ? 0 : yaw_ + dt_ * rate;
  r.imu_valid = !k_.faults.imu_silent.contains(r.step);
  r.yaw_rate = r.imu_valid ? rate : 0;
  r.yaw = r.imu_valid ? yaw_ : 0;
  if (k_.faults.imu_nan.contains(r.step)) r.yaw = r.yaw_rate = kNoNumber;
}

void PlatformSensors::weigh(const PerWheel& load, PlatformReading& r) {
  for (std::size_t i = 0; i < kWheels; ++i) {
    const double noise = 1 + k_.load_cells.noise * normal_(random_);
    const bool wrong = static_cast<int>(i) == k_.faults.wheel && k_.faults.load_wrong.contains(r.step);
    r.load[i] = (wrong ? kWrongLoad : 1) * load[i] * noise + load_bias_[i];
  }
  if (k_.faults.load_stuck.contains(r.step)) r.load = last_load_;
  last_load_ = r.load;
  r.load_valid = !k_.faults.load_silent.contains(r.step);
  if (!r.load_valid) r.load = {};
}

}  // namespace mrroc::sim
