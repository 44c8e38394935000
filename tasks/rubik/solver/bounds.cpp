#include "tasks/rubik/solver/bounds.hpp"

#include <algorithm>

#include "base/cube/symmetry.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kFirstSliceEdge = 8;

/// @return the power of 3 that the slot's twist counts in kTwist
std::uint64_t twist_weight(int slot) {
  std::uint64_t weight = slot == kCorners - 1 ? 0 : 1;
  for (int k = 0; k < slot; ++k) weight *= 3;
  return weight;
}

}  // namespace

Bounds::Bounds(const Tables& tables) : tables_(tables), large_(tables.has_large()) {
  // A cube whose pieces are all at home except that slot k has the value tells the value's term: what a symmetry
  // makes of a slot and its value does not depend on the other slots.
  for (int axis = 0; axis < kAxes; ++axis) {
    const Symmetry& s = symmetry(axis_rotation(axis));
    for (int slot = 0; slot < kCorners; ++slot)
      for (int value = 0; value < kCornerValues; ++value) {
        Cube cube;
        cube.corners[slot] = static_cast<std::uint8_t>(value);
        const int to = s.corner[slot];
        const int seen = conjugate(cube, s).corners[to];
        corner_terms_[slot][value] += seen % 3 * twist_weight(to) << (kField * axis);
        const std::uint64_t first = (kTetradPieces >> (seen / 3)) & 1;
        corner_terms_[slot][value] += first << (kTetradShift + kTetradField * axis + to);
      }
    for (int slot = 0; slot < kEdges; ++slot)
      for (int value = 0; value < kEdgeValues; ++value) {
        Cube cube;
        cube.edges[slot] = static_cast<std::uint8_t>(value);
        const int to = s.edge[slot];
        const int seen = conjugate(cube, s).edges[to];
        if (to < kEdges - 1)
          edge_terms_[slot][value] += static_cast<std::uint64_t>(seen & 1) << (kField * axis + to);
        if (axis < 2 && seen / 2 >= kFirstSliceEdge)
          edge_terms_[slot][value] += std::uint64_t{1} << (kSliceShift[axis] + slot);
      }
    for (int mask = 0; mask < 1 << kEdges; ++mask) {
      int moved = 0;
      for (int slot = 0; slot < kEdges; ++slot) moved |= ((mask >> slot) & 1) << s.edge[slot];
      slice_ranks_[axis][mask] = static_cast<std::uint16_t>(slice_rank(moved));
    }
  }
  for (int mask = 0; mask < 1 << kCorners; ++mask)
    tetrad_ranks_[mask] = static_cast<std::uint8_t>(tetrad_rank(mask));
}

int Bounds::corner_bound(const Cube& cube) const {
  const std::uint32_t member = tables_.corner_permutations.member_of[kCornerPermutation.of(cube)];
  const auto twist = static_cast<unsigned>(coordinates(cube).corners) & 0xfff;
  return static_cast<int>(tables_.corners(
      member / kAxisSymmetries, tables_.twist_seen[twist * kAxisSymmetries + member % kAxisSymmetries]));
}

int Bounds::lower_bound(const CubePair& pair) const {
  int largest = corner_bound(pair.cube);
  for (const Cube* cube : {&pair.cube, &pair.inverse}) {
    const AxisCoordinates c = coordinates(*cube);
    for (int axis = 0; axis < kAxes; ++axis) {
      largest = std::max(largest, bound(probe(c, axis), 0));
    }
  }
  return largest;
}

}  // namespace mrroc::rubik
