// Computes the pose of a camera in the hand (EIH, E_C T) or beside the robot (SAC, 0_C T) from pictures of
// the chessboard and the robot's poses.
#pragma once
#include <span>
#include <vector>

#include "vsp/calibration/lens.hpp"

namespace mrroc::vsp {

/// Arrangement of camera and board, and the meaning of the known poses.
enum class Arrangement : std::uint8_t {
  eye_in_hand,    ///< camera in the hand, board lies still; poses are 0_E T; wanted E_C T
  board_in_hand,  ///< camera stands still, board in the hand; poses are 0_E T; wanted 0_C T
  known_board,    ///< camera stands still; poses are those of the board, 0_G T; wanted 0_C T
};

/// One picture of the board and what was known when it was taken.
struct PosedView {
  BoardView view;  ///< its corners in the picture
  Pose known;      ///< 0_E T or 0_G T
};

/// Pose of the camera, and the residuals of the pictures.
struct PlaceCalibration {
  Pose camera;                  ///< E_C T or 0_C T
  Pose board;                   ///< 0_G T (eye_in_hand), E_G T (board_in_hand), identity (known_board)
  double rms_px{};              ///< [pixel]
  std::vector<double> view_px;  ///< of each view [pixel]
  double sigma_m{};             ///< standard deviation of the camera's position, the worst axis [m]
};

/// Starts from the hand-eye calibration of Park and Martin (1994), then minimises the reprojection error of all corners
/// of all pictures over both unknown poses.
/// @throws FaultError bad_calibration: fewer than 3 views (known_board: 1); the hand turned by less than 15 degrees, or
///         about one axis only; the pictures do not fit the poses (rms above 5 pixels); the position stays uncertain by
///         more than 5 mm
PlaceCalibration calibrate_place(const CameraModel& camera, Arrangement arrangement,
                                 std::span<const PosedView> views, const Board& board = kBoard);

}  // namespace mrroc::vsp
