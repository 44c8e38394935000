#include "vsp/calibration/bases.hpp"

namespace mrroc::vsp {

BasesByBoard calibrate_bases(const CameraModel& camera, const MovingArm& board_moves,
                             const MovingArm& camera_moves, const Board& board) {
  const PlaceCalibration of_board =
      calibrate_place(camera, Arrangement::board_in_hand, board_moves.views, board);
  const PlaceCalibration of_camera =
      calibrate_place(camera, Arrangement::eye_in_hand, camera_moves.views, board);
  const Pose by_board = of_board.camera * (board_moves.T_standing * of_camera.camera).inverse();
  const Pose by_camera = camera_moves.T_standing * of_board.board * of_camera.board.inverse();
  const Vector3 turn = angle_axis_from_rotation(by_board.R.transpose() * by_camera.R);
  return {.T_12 = {by_board.R * rotation_from_angle_axis(turn / 2), (by_board.p + by_camera.p) / 2},
          .T_E2C = of_camera.camera,
          .T_E1G = of_board.board,
          .apart_m = (by_board.p - by_camera.p).norm(),
          .apart_rad = turn.norm()};
}

}  // namespace mrroc::vsp
