#include "tasks/rubik/solver/fast_cube.hpp"

namespace mrroc::rubik {

const FastTurns& FastTurns::get() {
  static const FastTurns turns;
  return turns;
}

FastTurns::FastTurns() {
  const Cube solved;
  for (int m = 0; m < kMoves; ++m) {
    const Cube& t = turn(Move(m));
    int corners = 0, edges = 0;
    for (int k = 0; k < kCorners; ++k) {
      if (t.corners[k] == solved.corners[k]) continue;
      turns_[m].corner_to[corners] = static_cast<std::uint8_t>(k);
      turns_[m].corner_from[corners] = static_cast<std::uint8_t>(t.corners[k] / 3);
      turns_[m].twist[corners++] = static_cast<std::uint8_t>(t.corners[k] % 3);
    }
    for (int k = 0; k < kEdges; ++k) {
      if (t.edges[k] == solved.edges[k]) continue;
      turns_[m].edge_to[edges] = static_cast<std::uint8_t>(k);
      turns_[m].edge_from[edges] = static_cast<std::uint8_t>(t.edges[k] / 2);
      turns_[m].flip[edges++] = static_cast<std::uint8_t>(t.edges[k] % 2);
    }
  }
  for (int v = 0; v < kCornerValues; ++v) {
    for (int twist = 0; twist < 3; ++twist)
      twisted_[twist][v] = static_cast<std::uint8_t>(v / 3 * 3 + (v + twist) % 3);
    corner_back_[v] = {static_cast<std::uint8_t>(v / 3), static_cast<std::uint8_t>((3 - v % 3) % 3)};
  }
  for (int v = 0; v < kEdgeValues; ++v)
    edge_back_[v] = {static_cast<std::uint8_t>(v / 2), static_cast<std::uint8_t>(v % 2)};
}

}  // namespace mrroc::rubik
