// Sets of states that a pruning table covers, arranged so that it can be filled page by page.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/coordinates.hpp"

namespace mrroc::rubik {

/// States as (page, row, column): the page is a class of one coordinate under the 16 symmetries, row and column
/// are further coordinates seen through the symmetry that leads to the class's representative. A turn maps the
/// whole of a page onto another one, its rows and columns by two small tables, so that what is read and written
/// together lies in the first cache.
class CosetSpace {
 public:
  /// Destination of a page.
  struct Step {
    std::uint32_t page;      ///< to which the turn leads
    std::uint32_t symmetry;  ///< through which its rows and columns are seen, 0..15
  };

  /// @param page  the coordinate whose classes are the pages; outlives this object, as classes does
  /// @param row  nullptr: one row
  CosetSpace(const Coordinate& page, const SymmetryClasses& classes, const Coordinate* row,
             const Coordinate& column, std::span<const Move> moves);

  /// @return number of classes of the page's coordinate
  [[nodiscard]] int pages() const { return static_cast<int>(stabiliser_.size()); }
  /// @return rows of a page
  [[nodiscard]] int rows() const { return rows_; }
  /// @return columns of a row
  [[nodiscard]] int columns() const { return columns_; }
  /// @return number of turns
  [[nodiscard]] int moves() const { return moves_; }

  /// @return where turn k brings the page
  [[nodiscard]] Step step(int page, int k) const {
    const std::uint32_t to = steps_[static_cast<std::size_t>(page) * moves_ + k];
    return {to / kAxisSymmetries, to % kAxisSymmetries};
  }
  /// @return [row]: the row after turn k seen through the step's symmetry
  [[nodiscard]] const std::uint16_t* row_map(int k, std::uint32_t symmetry) const {
    return row_maps_.data() + static_cast<std::size_t>(k * kAxisSymmetries + symmetry) * rows_;
  }
  /// @return [column]: the column after turn k seen through the step's symmetry
  [[nodiscard]] const std::uint16_t* column_map(int k, std::uint32_t symmetry) const {
    return column_maps_.data() + static_cast<std::size_t>(k * kAxisSymmetries + symmetry) * columns_;
  }
  /// @return bit s: symmetry s maps the page to itself, so that entries of it are equal
  [[nodiscard]] unsigned stabiliser(int page) const { return stabiliser_[page]; }
  /// @return the row seen through the symmetry
  [[nodiscard]] int row_seen(int row, int symmetry) const {
    return row_seen_[row * kAxisSymmetries + symmetry];
  }
  /// @return the column seen through the symmetry
  [[nodiscard]] int column_seen(int column, int symmetry) const {
    return column_seen_[column * kAxisSymmetries + symmetry];
  }

  /// An entry of a table.
  struct Place {
    int page, row, column;  ///< each from 0 on
  };
  /// @return where the cube is
  [[nodiscard]] Place place_of(const Cube& cube) const;

 private:
  const Coordinate* page_;
  const SymmetryClasses* classes_;
  const Coordinate* row_;
  const Coordinate* column_;
  int rows_, columns_, moves_;
  std::vector<std::uint32_t> steps_;
  std::vector<std::uint16_t> stabiliser_;
  std::vector<std::uint16_t> row_seen_, column_seen_;
  std::vector<std::uint16_t> row_maps_, column_maps_;
};

}  // namespace mrroc::rubik
