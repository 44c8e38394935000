#include "sim/force_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc::sim {
namespace {

double quantised(double x, double resolution) {
  return resolution > 0 ? resolution * std::round(x / resolution) : x;
}

}  // namespace

ForceSensor::ForceSensor(const ForceSensorParameters& parameters, std::uint64_t seed)
    : parameters_(parameters), random_(seed) {
  std::uniform_real_distribution<double> offset(-1, 1);
  for (const Axis a : kAxes)
    bias_[a] = offset(random_) * (a < Axis::ax ? parameters_.force_bias : parameters_.torque_bias);
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

Wrench ForceSensor::healthy(const Wrench& true_load) {
  std::normal_distribution<double> normal;
  Wrench reading = true_load + bias_;
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
