// The sensors of a platform: encoders, inertial measurement unit and load cells.
#pragma once
#include <array>
#include <cstdint>
#include <random>

#include "base/platform_hardware.hpp"
#include "sim/motor.hpp"
#include "sim/platform/parameters.hpp"

namespace mrroc::sim {

/// What there is to be measured in a step.
struct PlatformMotion {
  PerWheel turned{};  ///< by the wheels since power-up [rad]
  double turn{};      ///< of the body about z in the step [rad]
  PerWheel load{};    ///< of the wheels, mean over the step [N]
  PerWheel torque{};  ///< of the motors at the wheels [N m]
};

/// Encoders in whole increments, noise and bias, and faults made on purpose. The same seed gives the same sequence of
/// readings.
class PlatformSensors {
 public:
  /// @param dt  duration of a step [s]
  PlatformSensors(const PlatformParameters& platform, std::uint64_t seed, double dt);

  /// @param step       number of the reading
  /// @param imu_reset  the yaw of the IMU is 0 in this step
  [[nodiscard]] PlatformReading measure(std::int64_t step, const PlatformMotion& motion, bool imu_reset);

  /// @return present offset of the yaw rate [rad/s]; for tests
  [[nodiscard]] double bias() const { return bias_; }

 private:
  void count(const PlatformMotion& motion, PlatformReading& r);
  void measure_turn(double turn, bool reset, PlatformReading& r);
  void weigh(const PerWheel& load, PlatformReading& r);

  PlatformParameters k_;
  double dt_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::array<Encoder, kWheels> encoder_;
  std::array<std::int32_t, kWheels> counted_{}, lost_{};  // [increments]
  double bias_{};                                         // of the rate [rad/s]
  double yaw_{};                                          // that the IMU has added up [rad]
  PerWheel load_bias_{};                                  // [N]
  PerWheel last_load_{};                                  // that the cells have shown [N]
};

}  // namespace mrroc::sim
