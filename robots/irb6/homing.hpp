// The homing of the IRb-6 arms: finds the positions of their motors.
#pragma once
#include "edp/driver_parameters.hpp"
#include "robots/irb6/parameters.hpp"

namespace mrroc::irb6 {

/// Source: the original framework. The order begins with the lower arm and ends with the column; the arm on the
/// track moves the track before the column. The motors read 0 where homing ends: the joints there are
/// Arm::synchronised().
/// @return homing of an arm
constexpr edp::HomingParameters homing_of(const ArmParameters& arm) {
  edp::HomingParameters h;
  h.first_axis = arm.first() + 1;
  // The last axis has the longest way and the lightest load: 0.05 rad per step in both phases.
  h.axis[static_cast<std::size_t>(arm.axis_count() - 1)] = {.coarse = 25, .fine = 25};
  return h;
}

}  // namespace mrroc::irb6
