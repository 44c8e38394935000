// Bases and cameras from the pictures of a run: which pose each arm had when a picture was taken, and what follows.
#pragma once
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "base/camera_config.hpp"
#include "base/config.hpp"
#include "mp/arm_trace.hpp"
#include "tasks/calibrate_cell/cell/view_plan.hpp"
#include "tasks/calibrate_cell/cell_run.hpp"
#include "tasks/calibrate_cell/figures.hpp"

namespace mrroc::calibrate_cell {

/// Time in which an arm has held still for a picture.
struct Still {
  Turn turn{};                   ///< in which it was
  double from{}, to{};           ///< simulated time [s]
  std::array<Pose, kArms> T_0E;  ///< of both arms, each in its own base
};
/// @param traces  of both arms, by their drivers @param plans  of both arms
/// @return all of them, those of each arm in their order; one during which the other arm did not wait is left out
[[nodiscard]] std::vector<Still> stills_of(const std::vector<mp::ArmTrace>& traces,
                                           const std::array<ViewPlan, kArms>& plans);

/// Where a camera was found.
struct CameraFound {
  CameraSetup camera;    ///< as it was believed
  Pose place;            ///< in the frame of its mount
  std::size_t stills{};  ///< in which the board was shown to it
  std::size_t seen{};    ///< of them, those of which a picture showed it
};

/// What the pictures say.
struct ByBoard {
  std::optional<Pose> T_12;          ///< base of arm2 in that of arm1; none: there is no camera in the hand
  Pose T_EG;                         ///< board in the hand; identity without such a camera
  std::vector<CameraFound> cameras;  ///< that in the hand first
};

/// @param sight  as everybody believes cameras and board @param records  of the cameras
/// @param bases  of arms that are found by touching, for the cameras that stand alone; none: those that the pictures tell
/// @throws FaultError kBoardNotSeen: a camera has seen the board too seldom; bad_calibration: the pictures do not fit the poses
[[nodiscard]] ByBoard find_by_board(const BelievedSight& sight, const std::vector<Still>& stills,
                                    const std::vector<CameraRecord>& records, const std::optional<Pose>& T_12,
                                    const Bases& believed);

}  // namespace mrroc::calibrate_cell
