#include "tasks/rubik/solver/coordinates.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "base/cube/symmetry.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {
namespace {

constexpr int kFirstSliceEdge = 8;

/// Sets of four out of N slots: their numbers, and the sets by number.
template <int N, int count>
struct Sets {
  std::array<std::uint16_t, 1 << N> rank{};
  std::array<std::uint16_t, count> mask{};

  constexpr Sets() {
    int n = 0;
    for (int m = 0; m < 1 << N; ++m) {
      if (std::popcount(static_cast<unsigned>(m)) != 4) continue;
      rank[m] = static_cast<std::uint16_t>(n);
      mask[n++] = static_cast<std::uint16_t>(m);
    }
  }
};
constexpr Sets<kEdges, kSlices> kSliceSets;
constexpr Sets<kCorners, kTetrads> kTetradSets;

constexpr std::array<std::uint8_t, 256> make_bit_counts() {
  std::array<std::uint8_t, 256> counts{};
  for (unsigned k = 0; k < 256; ++k) counts[k] = static_cast<std::uint8_t>(std::popcount(k));
  return counts;
}
constexpr auto kBitCount = make_bit_counts();

/// @return number of the permutation of 0 ... N-1, in lexicographic order
template <std::size_t N>
int rank_of(const std::array<std::uint8_t, N>& permutation) {
  int rank = 0;
  unsigned used = 0;
  for (std::size_t k = 0; k < N; ++k) {
    const unsigned v = permutation[k];
    rank = rank * static_cast<int>(N - k) + static_cast<int>(v) - kBitCount[used & ((1U << v) - 1)];
    used |= 1U << v;
  }
  return rank;
}

template <std::size_t N>
std::array<std::uint8_t, N> permutation_of(int rank) {
  std::array<std::uint8_t, N> digits{}, left{}, result{};
  for (std::size_t k = 1; k <= N; ++k) {
    digits[N - k] = static_cast<std::uint8_t>(rank % static_cast<int>(k));
    rank /= static_cast<int>(k);
  }
  std::iota(left.begin(), left.end(), std::uint8_t{0});
  for (std::size_t k = 0; k < N; ++k) {
    result[k] = left[digits[k]];
    std::copy(left.begin() + digits[k] + 1, left.end(), left.begin() + digits[k]);
  }
  return result;
}

int twist_of(const Cube& cube) {
  int twist = 0;
  for (int k = kCorners - 2; k >= 0; --k) twist = 3 * twist + cube.corners[k] % 3;
  return twist;
}

Cube cube_of_twist(int twist) {
  Cube cube;
  int sum = 0;
  for (int k = 0; k < kCorners - 1; ++k, twist /= 3) {
    cube.corners[k] = static_cast<std::uint8_t>(3 * k + twist % 3);
    sum += twist % 3;
  }
  cube.corners[kCorners - 1] = static_cast<std::uint8_t>(3 * (kCorners - 1) + (21 - sum) % 3);
  return cube;
}

int flip_slice_of(const Cube& cube) {
  int flips = 0, mask = 0;
  for (int k = 0; k < kEdges; ++k) {
    if (k < kEdges - 1) flips |= (cube.edges[k] & 1) << k;
    if (cube.edges[k] / 2 >= kFirstSliceEdge) mask |= 1 << k;
  }
  return slice_rank(mask) * kFlips + flips;
}

Cube cube_of_flip_slice(int value) {
  Cube cube;
  const int mask = kSliceSets.mask[value / kFlips];
  const int flips = value % kFlips;
  const int last = std::popcount(static_cast<unsigned>(flips)) & 1;
  int slice = kFirstSliceEdge, other = 0;
  for (int k = 0; k < kEdges; ++k) {
    const int piece = (mask >> k) & 1 ? slice++ : other++;
    cube.edges[k] = static_cast<std::uint8_t>(2 * piece + (k < kEdges - 1 ? (flips >> k) & 1 : last));
  }
  return cube;
}

int tetrad_of(const Cube& cube) {
  int mask = 0;
  for (int k = 0; k < kCorners; ++k) mask |= ((kTetradPieces >> (cube.corners[k] / 3)) & 1) << k;
  return tetrad_rank(mask);
}

Cube cube_of_tetrad(int value) {
  Cube cube;
  const int mask = kTetradSets.mask[value];
  std::array<std::array<int, 4>, 2> pieces{};
  std::array<int, 2> next{};
  for (int p = 0; p < kCorners; ++p) {
    const int first = (kTetradPieces >> p) & 1;
    pieces[first][next[first]++] = p;
  }
  next = {};
  for (int k = 0; k < kCorners; ++k) {
    const int first = (mask >> k) & 1;
    cube.corners[k] = static_cast<std::uint8_t>(3 * pieces[first][next[first]++]);
  }
  return cube;
}

int corner_permutation_of(const Cube& cube) {
  std::array<std::uint8_t, kCorners> p;
  for (int k = 0; k < kCorners; ++k) p[k] = static_cast<std::uint8_t>(cube.corners[k] / 3);
  return rank_of(p);
}

Cube cube_of_corner_permutation(int value) {
  Cube cube;
  const auto p = permutation_of<kCorners>(value);
  for (int k = 0; k < kCorners; ++k) cube.corners[k] = static_cast<std::uint8_t>(3 * p[k]);
  return cube;
}

template <int first, int count>
int edge_permutation_of(const Cube& cube) {
  std::array<std::uint8_t, count> p;
  for (int k = 0; k < count; ++k) p[k] = static_cast<std::uint8_t>(cube.edges[first + k] / 2 - first);
  return rank_of(p);
}

template <int first, int count>
Cube cube_of_edge_permutation(int value) {
  Cube cube;
  const auto p = permutation_of<count>(value);
  for (int k = 0; k < count; ++k) cube.edges[first + k] = static_cast<std::uint8_t>(2 * (first + p[k]));
  return cube;
}

}  // namespace

int slice_rank(int mask) { return kSliceSets.rank[mask]; }
int tetrad_rank(int mask) { return kTetradSets.rank[mask]; }

const Coordinate kTwist{kTwists, twist_of, cube_of_twist};
const Coordinate kFlipSlice{kFlipSlices, flip_slice_of, cube_of_flip_slice};
const Coordinate kTetrad{kTetrads, tetrad_of, cube_of_tetrad};
const Coordinate kCornerPermutation{kPermutations, corner_permutation_of, cube_of_corner_permutation};
const Coordinate kEdgePermutation{kPermutations, edge_permutation_of<0, 8>, cube_of_edge_permutation<0, 8>};
const Coordinate kSlicePermutation{kSlicePermutations, edge_permutation_of<8, 4>,
                                   cube_of_edge_permutation<8, 4>};

std::span<const Move> all_moves() {
  static const auto moves = [] {
    std::array<Move, kMoves> all;
    for (int m = 0; m < kMoves; ++m) all[m] = Move(m);
    return all;
  }();
  return moves;
}

std::vector<std::uint16_t> move_table(const Coordinate& coordinate, std::span<const Move> moves) {
  std::vector<std::uint16_t> table;
  table.reserve(coordinate.size * moves.size());
  for (int value = 0; value < coordinate.size; ++value) {
    const Cube cube = coordinate.cube(value);
    for (const Move m : moves) table.push_back(static_cast<std::uint16_t>(coordinate.of(cube * turn(m))));
  }
  return table;
}

std::vector<std::uint16_t> symmetry_table(const Coordinate& coordinate) {
  std::vector<std::uint16_t> table;
  table.reserve(static_cast<std::size_t>(coordinate.size) * kAxisSymmetries);
  for (int value = 0; value < coordinate.size; ++value) {
    const Cube cube = coordinate.cube(value);
    for (int s = 0; s < kAxisSymmetries; ++s)
      table.push_back(static_cast<std::uint16_t>(coordinate.of(conjugate(cube, symmetry(s)))));
  }
  return table;
}

SymmetryClasses::SymmetryClasses(const Coordinate& coordinate) {
  constexpr std::uint32_t kNone = ~0U;
  member_of.assign(coordinate.size, kNone);
  for (int value = 0; value < coordinate.size; ++value) {
    if (member_of[value] != kNone) continue;
    const auto number = static_cast<std::uint32_t>(representative.size());
    representative.push_back(static_cast<std::uint32_t>(value));
    std::uint16_t keeps = 0;
    const Cube cube = coordinate.cube(value);
    for (int s = 0; s < kAxisSymmetries; ++s) {
      const int image = coordinate.of(conjugate(cube, symmetry(s)));
      if (image == value) keeps = static_cast<std::uint16_t>(keeps | 1U << s);
      if (member_of[image] == kNone) member_of[image] = kAxisSymmetries * number + inverse_symmetry(s);
    }
    stabiliser.push_back(keeps);
  }
}

std::vector<std::uint32_t> class_move_table(const Coordinate& coordinate, const SymmetryClasses& classes,
                                            std::span<const Move> moves) {
  std::vector<std::uint32_t> table;
  table.reserve(classes.representative.size() * moves.size());
  for (const std::uint32_t value : classes.representative) {
    const Cube cube = coordinate.cube(static_cast<int>(value));
    for (const Move m : moves) table.push_back(classes.member_of[coordinate.of(cube * turn(m))]);
  }
  return table;
}

}  // namespace mrroc::rubik
