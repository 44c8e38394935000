// Fast turns of a cube for the searches' inner loops: only the eight pieces that move are touched.
#pragma once
#include <array>
#include <cstdint>

#include "base/cube/cube.hpp"
#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// A cube and its inverse, kept together. What solves one, undone, solves the other.
struct CubePair {
  Cube cube;     ///< as it is
  Cube inverse;  ///< what undoes it

  /// @return the cube with its inverse
  [[nodiscard]] static CubePair of(const Cube& c) { return {c, cube::inverse(c)}; }
};

/// The slots that each turn moves, and tables for what happens to the values in them.
class FastTurns {
 public:
  /// @return the tables, made at the first call
  static const FastTurns& get();

  /// @return the cube after the turn
  [[nodiscard]] Cube after(const Cube& c, Move m) const {
    Cube result = c;
    const Slots& t = turns_[m.index];
    for (int k = 0; k < 4; ++k) {
      result.corners[t.corner_to[k]] = twisted_[t.twist[k]][c.corners[t.corner_from[k]]];
      result.edges[t.edge_to[k]] = static_cast<std::uint8_t>(c.edges[t.edge_from[k]] ^ t.flip[k]);
    }
    return result;
  }

  /// @return cube and inverse after the turn of the cube
  [[nodiscard]] CubePair after(const CubePair& p, Move m) const {
    CubePair result{after(p.cube, m), p.inverse};
    const Slots& t = turns_[m.index];
    for (int k = 0; k < 4; ++k) {
      const int corner = t.corner_to[k];
      const int edge = t.edge_to[k];
      const Back c = corner_back_[result.cube.corners[corner]];
      result.inverse.corners[c.slot] = static_cast<std::uint8_t>(3 * corner + c.turned);
      const Back e = edge_back_[result.cube.edges[edge]];
      result.inverse.edges[e.slot] = static_cast<std::uint8_t>(2 * edge + e.turned);
    }
    return result;
  }

 private:
  struct Slots {
    std::array<std::uint8_t, 4> corner_to, corner_from, twist, edge_to, edge_from, flip;
  };
  struct Back {
    std::uint8_t slot, turned;
  };
  FastTurns();

  std::array<Slots, kMoves> turns_;
  std::array<std::array<std::uint8_t, kCornerValues>, 3> twisted_;
  std::array<Back, kCornerValues> corner_back_;
  std::array<Back, kEdgeValues> edge_back_;
};

}  // namespace mrroc::rubik
