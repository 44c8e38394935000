// Computes the intrinsics of a camera from pictures of the chessboard.
#pragma once
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/camera.hpp"
#include "base/image.hpp"
#include "base/target/board.hpp"

namespace mrroc::vsp {

/// One picture of the board.
struct BoardView {
  std::string name;              ///< of the picture, for reports
  std::vector<Vector2> corners;  ///< inner corners as Board::corner() counts them [pixel]
};

/// @return the inner corners of the one board in the picture, or nothing when there is none, or more than one
std::optional<std::vector<Vector2>> find_corners(const ImageView& picture, const Board& board = kBoard);

/// The model M, L of a camera and how well it explains the pictures.
struct LensCalibration {
  CameraModel model;            ///< k3 is 0: boards rarely reach the corners of pictures, where it would tell
  double rms_px{};              ///< over all corners of all views [pixel]
  std::vector<double> view_px;  ///< root mean square of each view [pixel]
  double sigma_f{};             ///< standard deviation of the focal length, relative
};

/// Least pictures with a board for a calibration of the lens.
inline constexpr std::size_t kLeastViews = 8;

/// OpenCV's calibrateCamera (Zhang, 2000).
/// @throws FaultError bad_calibration: fewer than kLeastViews views; the board faces the camera in all of them, or is
///         turned alike; it covers too little of the picture; the pictures do not fit together (rms above 1 pixel); the
///         focal length stays uncertain by more than 1 %
LensCalibration calibrate_lens(int width, int height, std::span<const BoardView> views,
                               const Board& board = kBoard);

}  // namespace mrroc::vsp
