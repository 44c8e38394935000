// The piece in each slot, without its orientation: this describes a cube in the second phase's group.
#pragma once
#include <array>
#include <cstdint>

#include "base/cube/cube.hpp"
#include "base/cube/symmetry.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// A permutation of the pieces. Arrangements multiply as cubes do.
struct Arrangement {
  std::array<std::uint8_t, kCorners> corners;  ///< the piece in each slot
  std::array<std::uint8_t, kEdges> edges;      ///< the piece in each slot

  /// @return that of the cube
  [[nodiscard]] static Arrangement of(const Cube& cube);
  friend constexpr bool operator==(const Arrangement&, const Arrangement&) = default;
};

/// Arrangements of cubes seen through the symmetries that keep the axis of U and D.
class SeenArrangements {
 public:
  /// @return the tables, made at the first call
  static const SeenArrangements& get();

  /// @return Arrangement::of(conjugate(cube, symmetry(s)))
  [[nodiscard]] Arrangement of(const Cube& cube, int s) const {
    const View& view = views_[s];
    Arrangement result;
    for (int k = 0; k < kCorners; ++k) result.corners[view.corner[k]] = view.corner_piece[cube.corners[k]];
    for (int k = 0; k < kEdges; ++k) result.edges[view.edge[k]] = view.edge_piece[cube.edges[k]];
    return result;
  }

 private:
  struct View {
    std::array<std::uint8_t, kCorners> corner;             ///< where each slot goes
    std::array<std::uint8_t, kEdges> edge;                 ///< where each slot goes
    std::array<std::uint8_t, kCornerValues> corner_piece;  ///< what the piece becomes, by a slot's value
    std::array<std::uint8_t, kEdgeValues> edge_piece;      ///< what the piece becomes, by a slot's value
  };
  SeenArrangements();

  std::array<View, kAxisSymmetries> views_;
};

}  // namespace mrroc::rubik
