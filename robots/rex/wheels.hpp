// What the wheels of Rex do for its body: speeds of rolling, and what a drive can give at a speed.
#pragma once
#include <algorithm>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {

/// @param v  forward speed of B [m/s]  @param w  [rad/s]
/// @return speeds of wheels that do not slip along themselves [rad/s]. Real-time safe.
[[nodiscard]] constexpr PerWheel rolling_speeds(double v, double w) noexcept {
  PerWheel speed{};
  for (std::size_t i = 0; i < kWheels; ++i) speed[i] = (v - kWheelY[i] * w) / kWheelRadius;
  return speed;
}

/// Torques that a drive can give [N m].
struct TorqueRange {
  double lower{};  ///< <= 0
  double upper{};  ///< >= 0
};

/// @param speed  of the wheel [rad/s]
/// @return what the drive can give: against the speed all it has; along with it less and less from kFullTorqueSpeed on, and
///         nothing from kMaxWheelSpeed on. Real-time safe.
[[nodiscard]] constexpr TorqueRange torque_range(double speed) noexcept {
  const auto share = [](double along) {
    return std::clamp((kMaxWheelSpeed - along) / (kMaxWheelSpeed - kFullTorqueSpeed), 0., 1.);
  };
  return {-kMaxTorque * share(-speed), kMaxTorque * share(speed)};
}

/// @param torque  [N m]
/// @return the same where it is within the limit, and the limit where it is beyond. Real-time safe.
[[nodiscard]] constexpr PerWheel within_limit(PerWheel torque) noexcept {
  for (double& t : torque) t = std::clamp(t, -kMaxTorque, kMaxTorque);
  return torque;
}

}  // namespace mrroc::rex
