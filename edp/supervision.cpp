#include "edp/supervision.hpp"

#include <cmath>

#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

constexpr bool pressed(std::uint8_t switches, AxisSwitch which) {
  return (switches & static_cast<unsigned>(which)) != 0;
}

}  // namespace

std::uint8_t at_limit_switch(const HardwareReading& reading) noexcept {
  unsigned motors = 0;
  for (std::size_t k = 0; k < reading.switches.size(); ++k)
    if (pressed(reading.switches[k], AxisSwitch::lower_limit) ||
        pressed(reading.switches[k], AxisSwitch::upper_limit))
      motors |= 1U << k;
  return static_cast<std::uint8_t>(motors);
}

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
    const bool lower = pressed(switches, AxisSwitch::lower_limit);
    const bool upper = pressed(switches, AxisSwitch::upper_limit);
    const bool moves_on = (lower && drives.commanded[k] < 0) || (upper && drives.commanded[k] > 0);
    if ((lower || upper) && (moves_on || (drives.leaving >> k & 1) == 0))
      return make_fault(FaultCode::limit_switch, axis.name, k, drives.measured[k],
                        lower ? axis.motor.lower : axis.motor.upper);
    const double speed = std::abs(motor_speed(axis, drives.increment[k], drives.time));
    const double max_speed = rules.over_speed * axis.max_motor_speed;
    if (!(speed <= max_speed)) return make_fault(FaultCode::over_speed, axis.name, k, speed, max_speed);
    const double error = drives.set[k] - drives.measured[k];
    if (!(std::abs(error) <= rules.following_error))
      return make_fault(FaultCode::following_error, axis.name, k, error, rules.following_error);
  }
  return {};
}

}  // namespace mrroc::edp
