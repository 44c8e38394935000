// The paper's chain from a picture to inner corners, one function a stage (Kornuta & Zielinski, VS (35)-(40)). Only for
// the sources of this folder and its tests.
#pragma once
#include <array>
#include <opencv2/core.hpp>
#include <vector>

namespace mrroc::vsp::chessboard {

/// The outline of what may be a dark square.
struct Quadrangle {
  std::array<cv::Point2f, 4> corner;  ///< clockwise in the picture [pixel]
  cv::Point2f centre;                 ///< [pixel]
  float shortest{};                   ///< edge [pixel]
};

/// A dark square with its place in a lattice.
struct Cell {
  std::size_t quadrangle{};  ///< which
  int i{};                   ///< column, any origin; i + j is even
  int j{};                   ///< row
  int turn{};  ///< corner k of the quadrangle is corner (k + turn) % 4 of the cell: upper left, upper
               ///< right, lower right, lower left
};
/// Dark squares that touch each other at their corners.
using Lattice = std::vector<Cell>;

/// Limits on the work of a stage, whatever the picture shows.
struct WorkLimits {
  std::size_t contours{6000};    ///< that are looked at, the first ones
  std::size_t quadrangles{800};  ///< that are kept, the first ones
};

/// (35) Light where a pixel is not darker than its surroundings.
/// @param grey    one channel
/// @param block   edge of the surroundings [pixel], odd
/// @param offset  how much darker than the mean of the surroundings dark pixels are [grey levels]
/// @return 255 light, 0 dark
cv::Mat threshold(const cv::Mat& grey, int block, int offset);

/// (36) Lets light grow by one pixel, so that dark squares that touch at their corners come apart. The paper dilates
/// the inverted picture, which would join them.
cv::Mat dilation(const cv::Mat& binary);

/// (37) Outlines of dark regions, in the order of the rows in which they end.
std::vector<std::vector<cv::Point>> contours(const cv::Mat& binary, const WorkLimits& limits);

/// (38) Those outlines that are convex quadrangles, grown again by what dilation took.
std::vector<Quadrangle> quadrangles(const std::vector<std::vector<cv::Point>>& contours,
                                    const WorkLimits& limits);

/// (39) Sorts quadrangles into lattices: two belong together when they meet at one corner, lie on opposite sides of it
/// and are of similar size. Quadrangles with no such neighbour are dropped.
/// @return lattices of at least 3 squares, the largest first
std::vector<Lattice> lattices(const std::vector<Quadrangle>& quadrangles);

}  // namespace mrroc::vsp::chessboard
