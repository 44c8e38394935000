// What the task must know of the robots and of the simulated cell: where the bases are believed, where they are, and whether
// the arms reach the balls.
#pragma once
#include "base/config.hpp"
#include "tasks/calibrate_cell/figures.hpp"
#include "tasks/calibrate_cell/viewing.hpp"

namespace mrroc::calibrate_cell {

/// Types of the arms unless robots.ARM.model says otherwise.
inline constexpr std::array<const char*, kArms> kModels{"irb6_postument", "irb6_track"};

/// Numbers of the arms' sets, in the order of their types' parameter_sets.
using SetNumbers = std::array<int, kArms>;

/// @return where the bases are believed before the run: cell.robots.ARM.place @throws ConfigError
[[nodiscard]] Bases believed_bases(const Config& config);
/// @return where they are: the simulator's sim.robots.ARM.place and .base_error, for figures only @throws ConfigError
[[nodiscard]] Bases true_bases(const Config& config);

/// @return where a camera of cameras.order is, in the frame of its mount, for figures only @throws ConfigError
[[nodiscard]] Pose true_camera(const Config& config, const std::string& key);

/// @return the sets of the simulator's arms, for figures only @throws ConfigError
[[nodiscard]] SetNumbers true_sets(const Config& config);

/// @return what both arms do for the pictures @throws ConfigError; FaultError bad_configuration
[[nodiscard]] std::array<ViewPlan, kArms> views_of(const Config& config);

/// Sets what follows from belief: task.ARM.balls, robots.ARM.start_joints before the balls where there are none, and the poses
/// for the pictures (plan_views()) where there are none; without pictures cameras.order is empty.
/// @throws ConfigError; FaultError bad_configuration: an arm does not reach that
void complete(Config& config);

/// Refuses balls that an arm does not reach from every side. @throws FaultError bad_configuration
void check_reach(const Config& config);

}  // namespace mrroc::calibrate_cell
