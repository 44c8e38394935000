// Pictures on the surfaces of bodies: calibration boards and tags.
#pragma once
#include <memory>

#include "base/image.hpp"
#include "sim/camera/scene.hpp"

namespace mrroc::camera {

/// A chessboard, with the frame G of whatever lies on a plate: origin in the middle, x to the right, y up when it is
/// read, z out of it. The upper left square is black.
struct BoardSize {
  int columns{9};  ///< inner corners along x, > 1; odd when rows is even, and the other way round: the board
                   ///< looks the same after half a turn otherwise
  int rows{6};     ///< inner corners along y, > 1
  double square{0.025};  ///< [m]
  int margin{1};         ///< width of the white border [squares]
};

/// Grey values of printed paper.
inline constexpr std::uint8_t kPaperWhite = 235;
inline constexpr std::uint8_t kPaperBlack = 18;

/// @param pixels  of the picture along a square
/// @return the board with its margin
std::shared_ptr<const Image> board_texture(const BoardSize& board, int pixels = 64);

/// Tags of the AprilTag family 36h11 that are known here, from 0.
inline constexpr int kKnownTags = 10;

/// @param id  0..kKnownTags-1
/// @param margin  width of the white border around the black one [cells], > 0
/// @param pixels  of the picture along a cell; there are 8 along the black border's edge
/// @throws std::invalid_argument  no such tag
std::shared_ptr<const Image> tag_texture(int id, int margin = 2, int pixels = 64);

/// Adds a plate with a chessboard on it. @param T_UG  its middle
void add_board(Scene& scene, const BoardSize& board, const Pose& T_UG);

/// Adds a plate with a tag on it.
/// @param edge  length of the black border [m] @param T_UG  middle of the tag
void add_tag(Scene& scene, int id, double edge, const Pose& T_UG);

}  // namespace mrroc::camera
