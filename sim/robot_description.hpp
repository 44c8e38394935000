// The URDF descriptions of the arms, as text inside the program.
#pragma once
#include <string_view>

#include "sim/world.hpp"

namespace mrroc::sim {

/// @return name of the robot, as in robots/irb6
std::string_view robot_name(ArmModel model);

/// @return its URDF
std::string_view robot_description(ArmModel model);

}  // namespace mrroc::sim
