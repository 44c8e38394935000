// The readings that the effector driver of a wheeled platform gets and the commands that it sends in one step. The
// same for a simulated platform and a real one. Wheels are in the order front left, front right, rear left, rear right.
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

namespace mrroc {

/// Wheels of a platform.
inline constexpr std::size_t kWheels = 4;
/// One number per wheel: FL, FR, RL, RR.
using PerWheel = std::array<double, kWheels>;

/// Everything measured in one step. Trivially copyable.
struct PlatformReading {
  std::int64_t step{};                          ///< number of the step, counts from 0
  std::array<std::int32_t, kWheels> encoder{};  ///< [increments] since power-up, forward positive
  double yaw{};        ///< of the IMU: integral of its own yaw_rate since its reset [rad], not wrapped
  double yaw_rate{};   ///< of the IMU [rad/s]
  bool imu_valid{};    ///< yaw and yaw_rate are measurements
  PerWheel load{};     ///< of the load cells: vertical force on each wheel [N]
  bool load_valid{};   ///< load is a measurement
  PerWheel current{};  ///< of the motors [A]
};

/// Set values for the drives, valid for one step. Trivially copyable.
struct PlatformDrive {
  std::int64_t step{};       ///< step of the reading that it answers
  PerWheel torque{};         ///< at the wheels [N m], finite, forward positive
  bool enabled{};            ///< false: the motors are short-circuited, the platform brakes
  bool imu_reset{};          ///< the IMU's yaw becomes 0 in this step
  std::int64_t macrostep{};  ///< of the driver's next step, as HardwareCommand has it
};

}  // namespace mrroc
