// Poses for the pictures: where the arms put the board and the camera so that the whole board is seen, from many sides, and
// the arms keep away from each other.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "base/camera_config.hpp"
#include "base/config.hpp"
#include "base/target/board.hpp"
#include "tasks/calibrate_cell/viewing.hpp"

namespace mrroc::calibrate_cell {

/// Cameras and board as everybody believes them.
struct BelievedSight {
  std::optional<CameraSetup> in_hand;  ///< of the arm kCameraArm; at most one
  std::vector<CameraSetup> fixed;      ///< known in the base of an arm or in the world
  Board board;                         ///< its size
  Pose T_EG;                           ///< its place in the hand of the arm kBoardArm
};
/// @return [cameras], [chessboard], [object]
/// @throws ConfigError; FaultError bad_configuration: a camera is in another hand than that of kCameraArm, or there are two;
///         the board is not in that of kBoardArm
[[nodiscard]] BelievedSight read_sight(const Config& config);

/// Where the board may be before a camera.
struct ViewRange {
  double nearest{}, farthest{};          ///< distance of its middle [m]
  double tilt{0.5};                      ///< largest angle between its normal and the line of sight [rad]
  double roll{};                         ///< largest turn about its normal, from `upright` [rad]
  Matrix3 upright{Matrix3::Identity()};  ///< C_G R of a board that faces the camera
};
/// @param n  number of the pose, from 0 @return C_G T of a series that fills the range evenly, the same on every machine
[[nodiscard]] Pose board_before(const CameraModel& camera, const ViewRange& range, int n);
/// @return whether all of the board is seen, with a margin for places that are not known well
[[nodiscard]] bool in_sight(const CameraModel& camera, const Board& board, const Pose& T_CG);

/// @param views  wanted of each turn @return what that arm does; empty without cameras
/// @throws ConfigError; FaultError bad_configuration: an arm cannot stand where it is to, or too few poses are in reach
[[nodiscard]] ViewPlan plan_views(const Config& config, std::size_t arm, std::size_t views);

}  // namespace mrroc::calibrate_cell
