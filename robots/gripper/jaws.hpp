// The two-jaw gripper of the IRb-6 arms: its transmission and its servo.
#pragma once
#include <cmath>
#include <numbers>

#include "edp/gripper.hpp"

namespace mrroc::gripper {

/// Transmission of the original's gripper: j = a m^2 + b m + c, falling where it is used.
inline constexpr double kA = -2.8313e-9;       ///< [m/rad^2]
inline constexpr double kB = -1.451910074e-5;  ///< [m/rad]
inline constexpr double kC = 0.074;            ///< distance where the motor reads 0 [m]
/// Motor position at the apex of the parabola [rad]: the linkage's dead centre, beyond the stop of the opening.
inline constexpr double kDeadCentre = -kB / (2 * kA);
/// Hard stops of the jaws [rad of the motor]: open at 0.091 m, closed at 0.0525 m.
inline constexpr double kOpenStop = -1800;
inline constexpr double kClosedStop = 1200;

/// @param motor [rad] @return distance between the jaws [m]; that of the dead centre beyond it
inline double distance(double motor) noexcept {
  const double m = motor > kDeadCentre ? motor : kDeadCentre;
  return (kA * m + kB) * m + kC;
}

/// @param distance between the jaws [m] @return motor position [rad]; the dead centre for larger distances
inline double motor(double distance) noexcept {
  const double beyond = (distance - kC) / kA + kDeadCentre * kDeadCentre;
  return kDeadCentre + std::sqrt(beyond > 0 ? beyond : 0);
}

/// @return change of the distance per motor angle [m/rad], negative
inline double slope(double motor) noexcept { return 2 * kA * motor + kB; }

/// Distances, encoder and over_current are the original's; the gains are made for the drive of sim/jaws.hpp, where
/// the hardest grip takes 0.18 A.
/// @return the driver's parameters of the gripper
inline edp::GripperParameters two_jaw() {
  edp::GripperParameters p;
  p.distance = distance;
  p.motor = motor;
  p.legal = {0.053, 0.0905};
  p.open_stop = kOpenStop;
  p.open_direction = -1;
  p.increments_per_rad = 128 / (2 * std::numbers::pi);
  p.speed = 1000;          // about 15 mm/s: the current of an impact stays below over_current
  p.opening_speed = 1500;  // about 25 mm/s
  p.acceleration = 2500;
  p.homing_speed = 250;  // 0.5 rad per step
  p.max_current = 0.15;
  p.stiffness = 0.03;
  p.damping = 0.001;
  p.current_gain = 100;
  p.over_current = 0.2;
  p.blocked_current = 0.1;
  p.blocked_motion = 0.5;
  p.blocked_steps = 25;
  return p;
}

}  // namespace mrroc::gripper
