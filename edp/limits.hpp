// Limits of the commands that an effector driver accepts.
#pragma once
#include "base/spatial.hpp"

namespace mrroc::edp {

/// What a command may ask for; the limits of joints, motors and motor speeds belong to the robot
/// (edp/robot.hpp). A command beyond one of them is refused, never clipped.
struct Limits {
  double linear_velocity{0.5};  ///< |v| of E [m/s]: commanded, in free motion under F_d, and computed
  double angular_velocity{2};   ///< |omega| of E [rad/s], the same
  Wrench force{{65, 65, 130, 5, 5, 5}};  ///< |F_d| per axis [N], [N m]: the IRb-6 wrists' constraints
  double inertia{1e3};                   ///< I [kg], [kg m^2]
  double mobility{1};                    ///< B [s/kg], [s/(kg m^2)]
  double weight{50};                     ///< w of the force tool [N]
  double lever{1};                       ///< |P| of the force tool, and length of the tool T_WE [m]
};

}  // namespace mrroc::edp
