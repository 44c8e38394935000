// Data of a platform that steers by the slip of its wheels, for its plant.
#pragma once

namespace mrroc::robots {

/// Constants of a platform with four driven wheels at (+-half_wheelbase, +-half_track) in B: what its makers say, and what
/// its kernel believes. The simulation may make a platform that differs from it.
struct SkidSteerParameters {
  double mass{};               ///< with the wheels [kg]
  double inertia{};            ///< about the vertical axis through the centre of mass [kg m^2]
  double wheel_radius{};       ///< r [m]
  double half_wheelbase{};     ///< a, from the middle to an axle [m]
  double half_track{};         ///< b, from the middle to a wheel's plane [m]
  double wheel_inertia{};      ///< J of a wheel with its motor behind its gear [kg m^2]
  double bearing_friction{};   ///< of a wheel, grows with its speed [N m s/rad]
  double slip_speed{};         ///< v_s of the kernel's friction: below it, friction grows with slip [m/s]
  double max_torque{};         ///< of a drive, at the wheel [N m]
  double full_torque_speed{};  ///< of the wheel, up to which a drive gives all of its torque [rad/s]
  double no_torque_speed{};    ///< at which it drives no more, larger [rad/s]
  double brake{};              ///< torque of a short-circuited motor at the wheel, by its speed [N m s/rad]
  double
      quick_stop{};  ///< torque at the wheel with which a drive brakes that gets no commands any more [N m]; 0: none
  double increments_per_turn{};  ///< of a wheel's encoder
  double torque_constant{};      ///< of a motor behind its gear [N m/A]
  double length{};               ///< of the outline, along x [m]
  double width{};                ///< of the outline, along y [m]
};

}  // namespace mrroc::robots
