// Limits of the commands that an effector driver accepts.
#pragma once
#include <optional>

#include "base/spatial.hpp"

namespace mrroc::edp {

/// Box along the axes of a frame.
struct Box {
  Vector3 lower = Vector3::Zero();  ///< [m]
  Vector3 upper = Vector3::Zero();  ///< [m]
};

/// Bounds of a command; the limits of joints, motors and motor speeds belong to the robot
/// (edp/robot.hpp). A command beyond one of them is refused; a set point that would go beyond one brings the
/// arm to rest, and the macrostep fails with the reason. Nothing is clipped.
struct Limits {
  double linear_velocity{0.5};  ///< |v| of E [m/s]: commanded, in free motion under F_d, and computed. In MIM
                                ///< the computed one counts, while the position is known: homing and jogging
                                ///< before it are bound by the speeds of the motors alone
  double angular_velocity{2};   ///< |omega| of E [rad/s], the same
  double linear_acceleration{100};   ///< of E's set velocity in TCIM [m/s^2]: a step of 0.2 m/s in 2 ms. The
                                     ///< papers' tables command steps of velocity; the drives smooth them
  double angular_acceleration{500};  ///< of E's set velocity in TCIM [rad/s^2]
  double motor_acceleration{50000};  ///< of every set motor position [rad/s^2]: from rest to 100 rad/s
  Wrench force{{65, 65, 130, 5, 5, 5}};  ///< |F_d| per axis [N], [N m]: the IRb-6 wrists' constraints
  /// |F_a| per axis of E [N], [N m] above which no motion may go on that pushes farther: at most nine tenths of
  /// the sensor's range, whose end is a fatal fault.
  Wrench contact_force{{58, 58, 130, 4.5, 4.5, 4.5}};
  std::optional<Box> workspace;  ///< of E in the base; none: only the reach and the axes' ranges count
  double inertia{1e3};           ///< I [kg], [kg m^2]
  double mobility{1};            ///< B [s/kg], [s/(kg m^2)]
  double weight{50};             ///< w of the force tool [N]
  double lever{1};               ///< |P| of the force tool, and length of the tool T_WE [m]
};

}  // namespace mrroc::edp
