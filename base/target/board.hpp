// The chessboard that the cameras look for; its size is defined only here.
#pragma once
#include <array>
#include <cstddef>

#include "base/spatial.hpp"

namespace mrroc {

/// A chessboard of dark and light squares with a light margin around them. Inner corners, where four squares meet,
/// are counted from the corner square at the upper left, which is dark. One of the two counts is odd and the other
/// even, so that the corner squares at the right are light: turned by 180 degrees the board looks different.
struct Board {
  int columns{9};        ///< inner corners along a row, odd
  int rows{6};           ///< inner corners along a column, even
  double square{0.025};  ///< edge of a square [m]
  double margin{0.025};  ///< width of the light margin [m]; the detector needs about a third of a square

  /// @return number of inner corners
  [[nodiscard]] constexpr int corners() const { return columns * rows; }
  /// @return edge of the whole plate along x [m]
  [[nodiscard]] constexpr double width() const { return (columns + 1) * square + 2 * margin; }
  /// @return edge of the whole plate along y [m]
  [[nodiscard]] constexpr double height() const { return (rows + 1) * square + 2 * margin; }
  /// @return whether the square in that row and column is dark, counted from the upper left one at 0, 0
  [[nodiscard]] static constexpr bool dark(int row, int column) { return (row + column) % 2 == 0; }
  /// @param row     0..rows-1
  /// @param column  0..columns-1
  /// @return the inner corner in G [m]. G lies in the middle of the board: x along the rows to the right, y up, z out
  ///         of the board toward the camera.
  [[nodiscard]] Vector3 corner(int row, int column) const {
    return {(column - 0.5 * (columns - 1)) * square, -(row - 0.5 * (rows - 1)) * square, 0};
  }
};

/// The board of the framework's tasks and calibration.
inline constexpr Board kBoard{};
static_assert((kBoard.columns + kBoard.rows) % 2 == 1,
              "the colours of the corner squares must tell the board's ends apart");

}  // namespace mrroc
