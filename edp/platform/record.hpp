// What is written down about every step of a platform's driver.
#pragma once
#include <cstdint>
#include <string>

#include "edp/platform/driver.hpp"

namespace mrroc::edp {

/// Everything about one step. Trivially copyable.
struct PlatformStepRecord {
  std::int64_t step{};                          ///< of the driver
  DriverState state{};                          ///< after the step
  FaultCode fault{};                            ///< that stood after the step
  PathPoint wanted;                             ///< where the platform is to be in this macrostep
  PlanarPose p;                                 ///< estimated, of the macrostep's beginning
  PlanarVelocity v;                             ///< estimated, of the macrostep's beginning
  std::array<std::int32_t, kWheels> encoder{};  ///< [increments] since power-up
  double yaw{};                                 ///< of the IMU [rad]
  double yaw_rate{};                            ///< of the IMU [rad/s]
  bool imu_valid{};                             ///< they are measurements
  PerWheel load{};                              ///< of the load cells [N]
  PerWheel current{};                           ///< [A]
  bool enabled{};                               ///< the drives follow the torques
  PerWheel torque{};                            ///< commanded [N m]

  /// @return names of the columns, with the end of the line
  [[nodiscard]] static std::string header();
  /// Appends the line of the step. @param dt  duration of a step [s]
  void append(std::string& text, double dt) const;
};

/// @return what the driver has made of a reading; call it after the step. Real-time safe
[[nodiscard]] PlatformStepRecord record_of(const PlatformDriver& driver, const PlatformReading& reading,
                                           const PlatformDrive& command) noexcept;

}  // namespace mrroc::edp
