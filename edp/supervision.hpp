// Supervision of the drives: what makes an effector stop at once.
#pragma once
#include <optional>

#include "base/fault.hpp"
#include "base/hardware.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/robot.hpp"

namespace mrroc::edp {

/// What the supervision looks at, per motor.
struct DriveObservation {
  AxisVector set;        ///< set positions of the step before [rad]
  AxisVector measured;   ///< positions [rad]
  AxisVector increment;  ///< motion since the reading before [encoder increments]
  double time;           ///< since the reading before [s]
};

/// @return the first malfunction - over_current, limit_switch, over_speed or following_error - with its axis,
///         value and limit, or nothing. Real-time safe
[[nodiscard]] std::optional<Fault> supervise_drives(const Robot& robot, const SupervisionParameters& rules,
                                                    const HardwareReading& reading,
                                                    const DriveObservation& drives) noexcept;

}  // namespace mrroc::edp
