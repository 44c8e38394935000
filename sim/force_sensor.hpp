// The wrist force/torque sensor: its readings of a true load.
#pragma once
#include <cstdint>
#include <random>

#include "base/spatial.hpp"

namespace mrroc::sim {

/// Defects of a sensor.
enum class SensorFault : std::uint8_t {
  none,
  stuck,      ///< repeats its last good reading
  saturated,  ///< z is at the end of its range
  silent,     ///< gives nothing: six NaN
  nan         ///< one component, ax, is not a number
};

/// Constants of the sensor; the order of magnitude is an ATI Gamma's.
struct ForceSensorParameters {
  double force_noise{0.05};          ///< standard deviation of one reading at 500 Hz [N]
  double torque_noise{0.003};        ///< standard deviation of one reading at 500 Hz [N m]
  double force_resolution{0.0125};   ///< [N], 0: none
  double torque_resolution{0.0006};  ///< [N m], 0: none
  double force_bias{3};              ///< largest constant offset, drawn once per seed [N]
  double torque_bias{0.1};           ///< largest constant offset, drawn once per seed [N m]
  double range_xy{65};               ///< readings saturate at +- this [N]
  double range_z{200};               ///< [N]
  double range_torque{5};            ///< [N m]
  SensorFault fault{};               ///< what breaks, on purpose
  std::int64_t fault_step{};         ///< number of the first broken reading; that of the arm at rest is 0
};

/// Bias, noise, range and quantisation, and faults made on purpose. The same seed gives the same sequence of readings.
class ForceSensor {
 public:
  /// @param seed  of bias and noise
  ForceSensor(const ForceSensorParameters& parameters, std::uint64_t seed);

  /// @param true_load  S_F: external load on the tool side of the sensor in S, gravity and the tool's
  /// inertial
  ///                   forces included, mean over the step [N, N m]
  /// @return raw reading S_F_m
  Wrench measure(const Wrench& true_load);

  /// @return the constant offset of this sensor [N, N m]; for tests
  [[nodiscard]] const Wrench& bias() const { return bias_; }

 private:
  [[nodiscard]] Wrench healthy(const Wrench& true_load);

  ForceSensorParameters parameters_;
  std::mt19937_64 random_;
  Wrench bias_;
  Wrench last_;  // good reading
  std::int64_t readings_{};
};

}  // namespace mrroc::sim
