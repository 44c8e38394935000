#include "tasks/rubik/solver/arrangement.hpp"

namespace mrroc::rubik {

Arrangement Arrangement::of(const Cube& cube) {
  Arrangement result;
  for (int k = 0; k < kCorners; ++k) result.corners[k] = static_cast<std::uint8_t>(cube.corners[k] / 3);
  for (int k = 0; k < kEdges; ++k) result.edges[k] = static_cast<std::uint8_t>(cube.edges[k] / 2);
  return result;
}

const SeenArrangements& SeenArrangements::get() {
  static const SeenArrangements views;
  return views;
}

SeenArrangements::SeenArrangements() {
  for (int s = 0; s < kAxisSymmetries; ++s) {
    const Symmetry& seen = symmetry(s);
    views_[s].corner = seen.corner;
    views_[s].edge = seen.edge;
    for (int v = 0; v < kCornerValues; ++v) views_[s].corner_piece[v] = seen.corner[v / 3];
    for (int v = 0; v < kEdgeValues; ++v) views_[s].edge_piece[v] = seen.edge[v / 2];
  }
}

}  // namespace mrroc::rubik
