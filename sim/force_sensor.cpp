#include "sim/force_sensor.hpp"

#include <algorithm>
#include <cmath>

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
