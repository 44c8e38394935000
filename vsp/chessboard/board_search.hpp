// The chain of stages (35)-(40) over one part of a picture. Only for the sources of this folder, the calibration and
// tests.
#pragma once
#include <vector>

#include "vsp/chessboard/inner_corners.hpp"

namespace mrroc::vsp::chessboard {

/// Where to look, and how.
struct Search {
  int x{};       ///< left end of the part of the picture [pixel]
  int y{};       ///< its upper end [pixel]
  int width{};   ///< [pixel], > 0, inside of the picture
  int height{};  ///< [pixel], > 0, inside of the picture
  int scale{1};  ///< by which it is enlarged for the stages before the inner corners
  int block{};   ///< surroundings for the threshold [pixel of the enlarged part], odd
  int offset{};  ///< of the threshold [grey levels]
  WorkLimits limits{};
};

/// Runs the chain. Inner corners are located in the picture itself, not in the enlarged part.
/// @param grey  one channel
/// @return the boards that were found
std::vector<InnerCorners> boards(const cv::Mat& grey, const Search& search, const Board& board);

}  // namespace mrroc::vsp::chessboard
