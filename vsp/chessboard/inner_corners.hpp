// Stage (40) of the chain: from a lattice of dark squares to the inner corners of the board, sub-pixel. Only for the
// sources of this folder and its tests.
#pragma once
#include <optional>

#include "base/camera.hpp"
#include "base/target/board.hpp"
#include "vsp/chessboard/chain.hpp"

namespace mrroc::vsp::chessboard {

/// Inner corners of a whole board, row by row as Board::corner() counts them.
struct InnerCorners {
  std::vector<Vector2> pixels;  ///< rows * columns of them [pixel]
  double shortest{};            ///< the smallest distance between neighbours [pixel]
};

/// Takes the corners at which the lattice's squares meet, and grows them over all places of the picture where the
/// pattern goes on: a corner is one where brightness changes like at the crossing of four squares. Squares that the
/// stages before have lost (glare, dirt, a joined outline) are bridged in that way, and a larger board cannot pass for
/// a part of itself. The ends of the board are told apart by the colours of its corner squares.
/// @param grey         the picture in which corners are located
/// @param quadrangles  in that picture's pixels
/// @return nothing unless exactly the board's rows and columns are there, and the picture shows that the pattern ends
///         on every side
std::optional<InnerCorners> inner_corners(const cv::Mat& grey, const std::vector<Quadrangle>& quadrangles,
                                          const Lattice& lattice, const Board& board);

/// Locates corners sub-pixel, in a window that fits between neighbours.
/// @param corners  pixels: where they are to within half a square; shortest decides the window
/// @return false when one of them is farther away than that
bool locate(const cv::Mat& grey, InnerCorners& corners);

}  // namespace mrroc::vsp::chessboard
