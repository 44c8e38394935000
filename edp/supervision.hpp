// Supervises the drives: detects what must stop an effector at once.
#pragma once
#include <cstdint>
#include <optional>

#include "base/fault.hpp"
#include "base/hardware.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// Input of the supervision, per motor.
struct DriveObservation {
  AxisVector set;        ///< set positions of the step before [rad]
  AxisVector measured;   ///< positions [rad]
  AxisVector increment;  ///< motion since the reading before [encoder increments]
  double time;           ///< since the reading before [s]
  AxisVector commanded;  ///< motion of the set positions in the step before [rad]
  std::uint8_t leaving;  ///< motors, bit k for motor k, that may leave a limit switch that is pressed
};

/// @param increment  of its encoder  @param time  in which it came [s]
/// @return speed of a motor [rad/s]. Real-time safe
[[nodiscard]] inline double motor_speed(const AxisProperties& axis, double increment, double time) noexcept {
  return increment / (axis.increments_per_rad * time);
}

/// @return motors, bit k for motor k, with a limit switch pressed. Real-time safe
[[nodiscard]] std::uint8_t at_limit_switch(const HardwareReading& reading) noexcept;

/// A motor that may leave a limit switch stands or moves away from it; when it moves on, that is a malfunction.
/// @return the first malfunction - over_current, limit_switch, over_speed or following_error - with its axis,
///         value and limit, or nothing. Real-time safe
[[nodiscard]] std::optional<Fault> supervise_drives(const Robot& robot, const SupervisionParameters& rules,
                                                    const HardwareReading& reading,
                                                    const DriveObservation& drives) noexcept;

}  // namespace mrroc::edp
