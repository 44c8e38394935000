// Data of a robot's motors, for its plant.
#pragma once
#include <limits>

namespace mrroc::robots {

/// Constants of one motor, all at the motor's shaft. docs/plant.md tells how the values were chosen.
struct MotorParameters {
  double resistance{};            ///< of the winding and the drive's bridge [ohm], positive
  double rotor_inertia{};         ///< [kg m^2], positive
  double friction{};              ///< of motor, gear and bearings in motion [N m]
  double presliding{0.02};        ///< turn within which friction builds up after a reversal [rad], positive
  double brake_torque{};          ///< torque at which the closed brake slips [N m]
  double torque_constant{0.105};  ///< K_t [N m/A], equal to K_e [V s/rad]
  double supply{48};              ///< voltage at full duty cycle [V]
  /// To which the drive limits the current of the motor that it drives [A], positive: its torque grows no further.
  double current_limit{std::numeric_limits<double>::infinity()};
};

}  // namespace mrroc::robots
