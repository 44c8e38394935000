// The simulated cell of the two IRb-6 arms, for tests and benchmarks.
#pragma once
#include "robots/irb6/robot_type.hpp"
#include "sim/world.hpp"

namespace mrroc::rig {

/// @return arm 1 (index 0) on its pedestal, arm 2 on its track, 2.1 m apart; no cube
inline sim::WorldParameters irb6_cell() {
  sim::WorldParameters world;
  world.arms = {sim::arm_parameters(irb6::postument()), sim::arm_parameters(irb6::track())};
  return world;
}

}  // namespace mrroc::rig
