// Distance from its goal at which an arm of the simulator comes to rest after commands that nothing follows:
// for tests, and in larger numbers for benchmarks.
#pragma once
#include <cstdint>
#include <string>

namespace mrroc::sim::test {

/// Worst of many motions to poses, measured in the simulator.
struct PoseGoalCount {
  int commands{};         ///< that were executed
  int refused{};          ///< beyond a limit or the reach, or too hard a beginning
  int faults{};           ///< motions that a fault has ended
  double error_mm{};      ///< distance of E from the goal, at rest with closed brakes
  double error_deg{};     ///< angle to the goal, the same
  double overshoot_mm{};  ///< how far E was beyond the goal, along the way from the start
  double set_error_mm{};  ///< of the set point at rest
  double acceleration{};  ///< greatest of a set motor position, of its limit
  double speed{};         ///< greatest of a set motor position or of E's set pose, of its limit
  int longest{};          ///< steps from the end of the commanded macrostep until the set point stands
  std::string worst;      ///< command with the greatest error
};

/// Random SET ARM commands with a pose - MIM in every representation, TCIM-POSE, absolute and relative, n_s 11 to 500 -
/// from rest, each followed by silence, with both arms from several poses.
/// @param in_a_row  commands without silence between them; the last goal counts
/// @throws FaultError internal_error: so many commands are refused that on average an arm executes not even one
PoseGoalCount count_pose_goals(int commands, std::uint64_t seed, int in_a_row = 1);

}  // namespace mrroc::sim::test
