// Voltage-driven DC motor behind a gear: what a PWM drive and its brake do to the shaft.
#pragma once
#include <algorithm>

#include "base/hardware.hpp"

namespace mrroc::sim {

/// Constants of one motor, all at the motor's shaft. docs/plant.md tells how the values were chosen.
struct MotorParameters {
  double resistance{};            ///< of the winding and the drive's bridge [ohm], positive
  double rotor_inertia{};         ///< [kg m^2]
  double friction{};              ///< Coulomb friction of motor, gear and bearings [N m]
  double brake_torque{};          ///< torque at which the closed brake slips [N m]
  double torque_constant{0.105};  ///< K_t [N m/A], equal to K_e [V s/rad]
  double supply{48};              ///< voltage at full duty cycle [V]
};

/// Winding current at a duty cycle and a speed; the winding's inductance is neglected (its time constant is
/// well below the step).
/// @param pwm    duty cycle in 1/kPwmScale of the supply, clipped to +-kPwmScale
/// @param speed  of the shaft [rad/s]
/// @return [A]; with pwm = 0 the motor is short-circuited and brakes
constexpr double motor_current(const MotorParameters& m, double pwm, double speed) {
  const double voltage = m.supply * std::clamp(pwm, -kPwmScale, kPwmScale) / kPwmScale;
  return (voltage - m.torque_constant * speed) / m.resistance;
}

/// @return torque on the rotor at that current, friction not included [N m]
constexpr double motor_torque(const MotorParameters& m, double current) {
  return m.torque_constant * current;
}

/// Mechanical time constant of speed after a step of voltage.
/// @param inertia  of everything that turns with the shaft, reduced to it [kg m^2]
/// @return [s]
constexpr double mechanical_time_constant(const MotorParameters& m, double inertia) {
  return m.resistance * inertia / (m.torque_constant * m.torque_constant);
}

}  // namespace mrroc::sim
