#include "edp/supervision.hpp"

#include <cmath>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

constexpr bool pressed(std::uint8_t switches, AxisSwitch which) {
  return (switches & static_cast<unsigned>(which)) != 0;
}

}  // namespace

std::optional<Fault> supervise_drives(const Robot& robot, const SupervisionParameters& rules,
                                      const HardwareReading& reading,
                                      const DriveObservation& drives) noexcept {
  const int axes = robot.axes();
  for (int k = 0; k < axes; ++k) {
    const AxisProperties& axis = robot.axis(k);
    const auto motor = static_cast<std::size_t>(k);
    const std::uint8_t switches = reading.switches[motor];
    if (pressed(switches, AxisSwitch::over_current))
      return make_fault(FaultCode::over_current, axis.name, k, reading.current[motor]);
    const double max_current = axis.servo.drive.max_current;
    if (!(std::abs(reading.current[motor]) <= max_current))
      return make_fault(FaultCode::over_current, axis.name, k, reading.current[motor], max_current);
    if (pressed(switches, AxisSwitch::lower_limit) || pressed(switches, AxisSwitch::upper_limit))
      return make_fault(FaultCode::limit_switch, axis.name, k, drives.measured[k],
                        pressed(switches, AxisSwitch::lower_limit) ? axis.motor.lower : axis.motor.upper);
    const double speed = std::abs(drives.increment[k]) / (axis.increments_per_rad * drives.time);
    const double max_speed = rules.over_speed * axis.max_motor_speed;
    if (!(speed <= max_speed)) return make_fault(FaultCode::over_speed, axis.name, k, speed, max_speed);
    const double error = drives.set[k] - drives.measured[k];
    if (!(std::abs(error) <= rules.following_error))
      return make_fault(FaultCode::following_error, axis.name, k, error, rules.following_error);
  }
  return {};
}

}  // namespace mrroc::edp
