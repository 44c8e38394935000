// What the task must know of the robots and of the simulated cell: where the arms stand, and whether they reach everything.
#pragma once
#include "base/config.hpp"
#include "tasks/ball/ball.hpp"
#include "tasks/ball/hand_push.hpp"

namespace mrroc::ball {

/// Sets robots.ARM.start_joints where the configuration has none: palms on both sides of the object, apart from it.
/// @throws ConfigError; FaultError bad_configuration: an arm does not reach that
void complete_start(Config& config);

/// @return the task's parameters with the places of the arms
/// @throws ConfigError; FaultError bad_configuration: an arm does not reach the circle
[[nodiscard]] Parameters read_setup(const Config& config);

/// @return the force of the push along the axes of the arm's sheet, in which a simulated hand counts [N] @throws ConfigError
[[nodiscard]] Vector3 force_in_sheet(const Config& config, const HandPush& push);

}  // namespace mrroc::ball
