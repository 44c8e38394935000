// Gears that give way: rotors with an inertia of their own, coupled to the links by springs and dampers.
#pragma once
#include <span>

#include "base/axes.hpp"
#include "sim/motor.hpp"

namespace mrroc::sim {

/// How far the gears of an arm give way.
struct ElasticityParameters {
  double frequency{};    ///< lowest mode of the links at the start, rotors held [Hz]; 0: gears are rigid
  double damping{0.03};  ///< damping ratio of that mode, 0..1
};

/// Share of a rotor's inertia that lies on the side of the link: that of the gear's wheels there. Without it the last
/// wrist axis, which bears next to nothing, would swing faster than the integration follows. It has no other source; its
/// influence on stable contact is in docs/stability.md: little below 0.1, while from 0.12 on that axis swings by itself.
inline constexpr double kGearShare = 0.1;

/// An arm at rest at its start, as its gears feel it.
struct ArmAtRest {
  AxisVector joints;   ///< [rad], track [m]
  AxisMatrix mass;     ///< mass matrix of links and kGearShare of the rotors [kg m^2], track [kg]
  AxisVector holding;  ///< what the gears hold the links with [N m], track [N]
};

/// The gears of one arm. Springs act at the joints: between where a rotor would have its joint and where it is.
/// An axis is as stiff as the inertia that it moves, its rotor's included, in a proportion that is the same for all and
/// gives the lowest mode its frequency. Real-time safe after the construction.
class ElasticGears {
 public:
  /// Rotors stand turned so that the springs hold the links.
  /// @param motors_per_joints  d motors / d joints at the start
  /// @param h                  integration step [s]
  /// @throws std::invalid_argument  a parameter is out of range
  /// @throws FaultError bad_configuration  the step is too long for the fastest mode, or for how it is damped
  ElasticGears(const ElasticityParameters& p, const ArmAtRest& arm, std::span<const MotorParameters> motors,
               const AxisMatrix& motors_per_joints, double h);

  /// Moves the rotors by one integration step.
  /// @param joints, speeds     of the links at its beginning [rad, track m]
  /// @param torques            on the shafts, of motors and friction [N m]
  /// @param braked             the brakes hold the shafts
  /// @param motors_per_joints  d motors / d joints at joints()
  /// @return torques of the springs on the links during the step [N m], track [N]
  [[nodiscard]] AxisVector step(const AxisVector& joints, const AxisVector& speeds, const AxisVector& torques,
                                bool braked, const AxisMatrix& motors_per_joints);

  /// @return where the rotors would have the joints if gears were rigid [rad], track [m]
  [[nodiscard]] const AxisVector& joints() const { return joints_; }
  /// @return speeds of the shafts [rad/s]
  [[nodiscard]] const AxisVector& shaft_speeds() const { return shaft_speeds_; }
  /// @return of the springs, at the joints [N m/rad], track [N/m]
  [[nodiscard]] const AxisVector& stiffness() const { return stiffness_; }

 private:
  AxisVector stiffness_, damping_;    // at the joints
  AxisVector rotors_, brakes_;        // inertia [kg m^2] and torque [N m] at the shafts
  AxisVector joints_, shaft_speeds_;  // of the rotors
  double h_;
};

}  // namespace mrroc::sim
