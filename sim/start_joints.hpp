// The joints of an arm at the beginning, computed without a World.
#pragma once
#include "base/axes.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// @return joints of an arm at the beginning [rad], track [m]: those of its parameters, else those of its type
/// @throws std::invalid_argument  another number than the robot has axes, or the tool does not reach the sheet
[[nodiscard]] AxisVector start_joints(const ArmParameters& arm);

}  // namespace mrroc::sim
