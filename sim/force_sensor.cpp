#include "sim/force_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "sim/seed.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {
namespace {

double quantised(double x, double resolution) {
  return resolution > 0 ? resolution * std::round(x / resolution) : x;
}

}  // namespace

ForceSensor::ForceSensor(const ForceSensorParameters& parameters, std::uint64_t seed)
    : parameters_(parameters),
      random_(seed),
      R_true_S_(rotation_from_angle_axis(parameters.turn).transpose()),
      loads_(static_cast<std::size_t>(parameters.delay)) {
  std::uniform_real_distribution<double> offset(-1, 1);
  for (const Axis a : kAxes)
    bias_[a] = offset(random_) * (a < Axis::ax ? parameters_.force_bias : parameters_.torque_bias);
  std::mt19937_64 of_drift(mixed(seed));
  for (const Axis a : kAxes)
    drift_[a] =
        kStep * offset(of_drift) * (a < Axis::ax ? parameters_.force_drift : parameters_.torque_drift);
}

Wrench ForceSensor::measure(const Wrench& true_load) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const bool broken = readings_++ >= parameters_.fault_step;
  Wrench reading = healthy(true_load);
  switch (broken ? parameters_.fault : SensorFault::none) {
    case SensorFault::none:
      last_ = reading;
      break;
    case SensorFault::stuck:
      return last_;
    case SensorFault::saturated:
      reading[Axis::z] = parameters_.range_z;
      break;
    case SensorFault::silent:
      reading.v.fill(kNothing);
      break;
    case SensorFault::nan:
      reading[Axis::ax] = kNothing;
      break;
  }
  return reading;
}

/// Until there are readings so old, that of the beginning.
Wrench ForceSensor::delayed(const Wrench& load) {
  if (loads_.empty()) return load;
  const auto place = static_cast<std::size_t>(readings_ - 1) % loads_.size();
  if (readings_ == 1) std::ranges::fill(loads_, load);
  return std::exchange(loads_[place], load);
}

Wrench ForceSensor::amplified(const Wrench& load) const {
  if (parameters_.gain == 1 && parameters_.turn.isZero(0)) return load;
  return parameters_.gain * xi_star(R_true_S_, load);
}

Wrench ForceSensor::healthy(const Wrench& load) {
  std::normal_distribution<double> normal;
  Wrench reading = amplified(delayed(load)) + bias_;
  if (parameters_.force_drift != 0 || parameters_.torque_drift != 0)
    reading = reading + static_cast<double>(readings_ - 1) * drift_;
  for (const Axis a : kAxes) {
    const bool force = a < Axis::ax;
    const double noise = force ? parameters_.force_noise : parameters_.torque_noise;
    const double range = !force         ? parameters_.range_torque
                         : a == Axis::z ? parameters_.range_z
                                        : parameters_.range_xy;
    reading[a] = quantised(std::clamp(reading[a] + noise * normal(random_), -range, range),
                           force ? parameters_.force_resolution : parameters_.torque_resolution);
  }
  return reading;
}

}  // namespace mrroc::sim
