// The wrist force/torque sensor: its readings of a true load.
#pragma once
#include <cstdint>
#include <random>
#include <vector>

#include "base/pose.hpp"

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
  double gain{1};                    ///< reading over load, of all axes
  Vector3 turn{Vector3::Zero()};     ///< of its true axes against those of S, angle times axis [rad]
  double force_drift{};              ///< largest drift of the offset, drawn once per seed [N/s]
  double torque_drift{};             ///< the same [N m/s]
  int delay{};                       ///< readings are so many steps old
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

  /// @return the constant part of the offset of this sensor [N, N m]; for tests
  [[nodiscard]] const Wrench& bias() const { return bias_; }

 private:
  [[nodiscard]] Wrench healthy(const Wrench& load);
  [[nodiscard]] Wrench delayed(const Wrench& load);
  [[nodiscard]] Wrench amplified(const Wrench& load) const;

  ForceSensorParameters parameters_;
  std::mt19937_64 random_;
  Wrench bias_;
  Wrench drift_;               // per reading
  Matrix3 R_true_S_;           // S as its true axes have it
  std::vector<Wrench> loads_;  // the last ones, round about; empty: none is kept
  Wrench last_;                // good reading
  std::int64_t readings_{};
};

}  // namespace mrroc::sim
