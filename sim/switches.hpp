// Switches and encoder zero marks of the simulated motors, and their possible defects.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/hardware.hpp"
#include "edp/robot.hpp"

namespace mrroc::sim {

/// Defects of the parts by which one motor is homed.
enum class SwitchFault : std::uint8_t {
  none,
  missing,  ///< the synchronisation switch is never pressed
  stuck,    ///< it is always pressed
  no_index  ///< the encoder gives no zero mark
};

/// Synchronisation switch of one motor.
struct SwitchParameters {
  double place{
      -3};  ///< motor position below which the switch is pressed [rad]. Homing is exact while it lies
            ///< between -2 pi and 0: the zero mark at 0 is then the first one above it
  SwitchFault fault{SwitchFault::none};  ///< made on purpose
};

/// Readings of one motor's switches. The limit switches lie at the ends of the motor's legal range.
/// @param motor  true position [rad] @param before  the same one step before @param legal range of the motor
/// @return AxisSwitch bits
inline std::uint8_t read_switches(const SwitchParameters& p, double motor, double before,
                                  const edp::Range& legal) {
  unsigned bits = 0;
  const auto set = [&bits](AxisSwitch which, bool on) {
    if (on) bits |= static_cast<unsigned>(which);
  };
  const double turn = 2 * std::numbers::pi;
  set(AxisSwitch::lower_limit, motor < legal.lower);
  set(AxisSwitch::upper_limit, motor > legal.upper);
  set(AxisSwitch::synchro,
      p.fault == SwitchFault::stuck || (p.fault != SwitchFault::missing && motor < p.place));
  set(AxisSwitch::index,
      p.fault != SwitchFault::no_index && std::floor(motor / turn) != std::floor(before / turn));
  return static_cast<std::uint8_t>(bits);
}

/// @return position of the zero mark passed last between two positions of a motor [rad]
inline double last_mark(double motor, double before) {
  const double turn = 2 * std::numbers::pi;
  return turn * std::max(std::floor(motor / turn), std::floor(before / turn));
}

}  // namespace mrroc::sim
