// Voltage-driven DC motor behind a gear: torques of a PWM drive and of the brake on the shaft.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/hardware.hpp"
#include "robots/motor.hpp"

namespace mrroc::sim {

using robots::MotorParameters;

/// Winding current at a duty cycle and a speed; the winding's inductance is neglected (its time constant is
/// well below the step).
/// @param pwm    duty cycle in 1/kPwmScale of the supply, clipped to +-kPwmScale
/// @param speed  of the shaft [rad/s]
/// @return [A]; with pwm = 0 the motor is short-circuited and brakes
constexpr double motor_current(const MotorParameters& m, double pwm, double speed) {
  const double voltage = m.supply * std::clamp(pwm, -kPwmScale, kPwmScale) / kPwmScale;
  return (voltage - m.torque_constant * speed) / m.resistance;
}

/// Current of a winding whose drive limits it.
struct LimitedCurrent {
  double current{};  ///< [A]
  bool limited{};    ///< it would be more
};
/// @param current  without the limit [A]
/// @return what the drive lets through
constexpr LimitedCurrent limited_current(const MotorParameters& m, double current) {
  const double let_through = std::clamp(current, -m.current_limit, m.current_limit);
  return {let_through, let_through != current};
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

/// Friction of a shaft by Dahl's model: a spring that yields at the Coulomb torque. Over the first fraction
/// of a degree gears, screws and bearings are elastic; a model that sticks rigidly instead makes any servo
/// with integral action hunt. P. Dahl, "A solid friction model", 1968.
class ShaftFriction {
 public:
  /// @param m      gives friction and presliding
  /// @param speed  of the shaft [rad/s]
  /// @param h      duration [s]
  /// @return torque on the shaft during the next h, against the motion [N m]
  double step(const MotorParameters& m, double speed, double h) {
    deflection_ = (deflection_ + h * speed) / (1 + h * std::abs(speed) / m.presliding);
    return -m.friction * deflection_ / m.presliding;
  }
  /// @return elastic deflection [rad], within +-presliding
  [[nodiscard]] double deflection() const { return deflection_; }

 private:
  double deflection_{};
};

/// Incremental encoder: whole increments since power-up.
class Encoder {
 public:
  /// @param increments_per_rad  of the motor shaft
  /// @param phase               place of the shaft within an increment at power-up, [0, 1)
  Encoder(double increments_per_rad, double phase) : increments_per_rad_(increments_per_rad), phase_(phase) {}

  /// @param turned  by how much the shaft turned since power-up [rad]
  [[nodiscard]] std::int32_t count(double turned) const {
    return static_cast<std::int32_t>(std::floor(turned * increments_per_rad_ + phase_));
  }

 private:
  double increments_per_rad_;
  double phase_;
};

}  // namespace mrroc::sim
