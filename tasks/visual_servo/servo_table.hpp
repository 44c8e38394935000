// servo.csv: a row for every control step of a run, and the figures computed from it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "base/pose.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::visual_servo {

/// Number of the behaviour from memory in servo.csv.
inline constexpr int kRemembered = 4;

/// One control step.
struct ServoRow {
  std::int64_t k{};   ///< control step, from 0
  double t{};         ///< simulated time at which x_c was looked at [s]
  int behaviour{};    ///< of VS: 0 idle or given up, 1 PB-SAC, 2 PB-EIH, 3 both; kRemembered
  bool sac_seen{};    ///< that camera sees
  bool eih_seen{};    ///< the same of the camera in the hand
  bool refused{};     ///< the driver could not do what it was told two control steps before
  double set_step{};  ///< way of E's set pose in each step of the command that is made now [m]
  Pose e;             ///< aggregated error, predicted for the start of the command; identity in idle
  Pose true_e;        ///< true displacement of E to the desired pose, at t
  Pose known_e;       ///< the same as the tool's camera knows it, had it neither noise nor a wrong lens
  Pose T_0E;          ///< at t
  Vector3 v{Vector3::Zero()};  ///< true velocity of the object at t, along the base [m/s]; zero: at rest
  bool object_there{true};     ///< at t
};
using ServoTable = std::vector<ServoRow>;  ///< a row per control step, in order

/// Writes `k,t,behaviour,sac_seen,eih_seen,err_x,err_y,err_z,err_angle,true_err_mm,true_err_deg`; the errors of a step
/// without one are nan.
/// @throws FaultError cannot_write
void write_servo_table(const std::filesystem::path& file, const ServoTable& table);

/// The last second: what "at the end" means.
inline constexpr double kEnd = 1;
/// The last seconds of a motion of the object: what "while it moves" means; until then the arm catches up.
inline constexpr double kFollowing = 2;

/// How long after a change of cameras the arm goes over to what the new ones see [s].
inline constexpr double kChange = 0.5;

/// @return figures of a run; those that it cannot have are missing, as when nothing was ever seen. Of the error that the
/// tool's camera can know:
///   final_err_mm, final_err_deg   mean over the last second, of an object that is at rest then
///   steps_to_2mm                  control steps from the first one in which a camera saw it until it stays below 2 mm;
///                                 object at rest
/// Of the true error:
///   true_err_mm                   as final_err_mm: what it is more, calibrating the tool's camera takes away
///   overshoot_pct                 farthest beyond the goal along the way from the first place, of that way; object at
///                                 rest
///   follow_err_mm                 while the object moves: mean
///   line_lag_mm                   while the object moves on a straight line: mean component along the motion, positive
///                                 when E is behind
///   refused_steps                 displacements that the driver could not do; missing when there are none
///   camera_change_mm              greatest way of E's set pose in one step of the servo, within kChange after the arm goes by
///                                 other cameras than before; missing when it does not
///   unseen_pct                    control steps without a camera that sees
///   arm_moved_mm                  farthest that E was from its first place
[[nodiscard]] mp::Figures figures_of(const ServoTable& table);

}  // namespace mrroc::visual_servo
