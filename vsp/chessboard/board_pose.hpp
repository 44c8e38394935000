// From inner corners to a pose of the board, and from a pose to the place in the next picture where the board is looked
// for first. Only for the sources of this folder and its tests.
#pragma once
#include <opencv2/core.hpp>
#include <optional>

#include "vsp/chessboard/board_search.hpp"
#include "vsp/planar_pose.hpp"

namespace mrroc::vsp::chessboard {

/// @param T_CG    where the board was
/// @param offset  of the threshold [grey levels]
/// @return the part of the picture around it, enlarged until its squares are 16 pixels wide, at most three times and
///         at most to the size of the whole picture
Search search_around(const CameraModel& camera, const Board& board, const Pose& T_CG, int offset);

/// Where a corner is off by three times the root mean square of all, it has slid along an edge: all are located again, from
/// where the pose has them, and the better pose is taken.
std::optional<PlanarPoses> board_pose(const cv::Mat& grey, const CameraModel& camera, const Board& board,
                                      const InnerCorners& corners, const PlanarPoseParameters& parameters);

}  // namespace mrroc::vsp::chessboard
