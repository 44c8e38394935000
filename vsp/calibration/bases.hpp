// The base of one arm in that of another one, from pictures: arm 1 holds the chessboard, arm 2 a camera.
#pragma once
#include <vector>

#include "vsp/calibration/hand_eye.hpp"

namespace mrroc::vsp {

/// Pictures during which one of both arms moves and the other one stands.
struct MovingArm {
  std::vector<PosedView> views;  ///< known: 0_E T of the arm that moves, in its own base
  Pose T_standing;               ///< 0_E T of the other one, in its own base
};

/// Where the arms, the camera and the board are.
struct BasesByBoard {
  Pose T_12;   ///< base of arm 2 in that of arm 1
  Pose T_E2C;  ///< camera in the hand of arm 2
  Pose T_E1G;  ///< board in the hand of arm 1
  /// Pictures with a board that moves and those with a camera that moves each give T_12; between both of them: distance of
  /// the origins [m], angle [rad].
  double apart_m{}, apart_rad{};
};

/// Board in a moving hand, and camera in a moving hand (calibrate_place()); T_12 is the mean of what both say.
/// @param board_moves   arm 1 moves the board, arm 2 stands @param camera_moves  the other way round
/// @throws FaultError bad_calibration  as calibrate_place()
BasesByBoard calibrate_bases(const CameraModel& camera, const MovingArm& board_moves,
                             const MovingArm& camera_moves, const Board& board = kBoard);

}  // namespace mrroc::vsp
