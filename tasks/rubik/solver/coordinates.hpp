// Coordinates of a cube's state as whole numbers, and the effect of turns and symmetries on them.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/cube/cube.hpp"
#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// A part of the state as a number from 0 to size - 1. A turn changes it in a way that depends on nothing else,
/// and so does a symmetry that keeps the axis of U and D.
struct Coordinate {
  int size;                 ///< count of numbers
  int (*of)(const Cube&);   ///< the number of a cube
  Cube (*cube)(int value);  ///< a cube, reachable or not, with this number
};

inline constexpr int kTwists = 2187;                  ///< 3^7: of seven corners
inline constexpr int kFlips = 2048;                   ///< 2^11: of eleven edges
inline constexpr int kSlices = 495;                   ///< four out of twelve slots
inline constexpr int kFlipSlices = kFlips * kSlices;  ///< of both together
inline constexpr int kTetrads = 70;                   ///< four out of eight slots
inline constexpr int kPermutations = 40320;           ///< 8!: of corners, or of the edges of U and D
inline constexpr int kSlicePermutations = 24;         ///< 4!: of the edges of the middle slice

/// @param mask  bit k: slot k holds one of the four edges at home between U and D
/// @return number of the set of four slots out of twelve; 0 for other masks
[[nodiscard]] int slice_rank(int mask);
/// @param mask  bit k: slot k holds one of the corners URF, ULB, DLF, DRB
/// @return number of the set of four slots out of eight; 0 for other masks
[[nodiscard]] int tetrad_rank(int mask);
/// The corners of one of the two tetrahedra, bit k: piece k. Half turns keep each corner in its tetrahedron.
inline constexpr int kTetradPieces = 0b10100101;

/// Twists of seven corners; the eighth follows. Zero in the group that the second phase searches.
extern const Coordinate kTwist;
/// Flips of eleven edges and the slots of the four edges of the middle slice: slice * 2048 + flips.
extern const Coordinate kFlipSlice;
/// Which slots the corners of the first tetrahedron are in.
extern const Coordinate kTetrad;
/// The permutation of the corners.
extern const Coordinate kCornerPermutation;
/// The permutation of the eight edges of U and D; only for cubes with the other four in their slice.
extern const Coordinate kEdgePermutation;
/// The permutation of the four edges of the middle slice; only for cubes with these in their slice.
extern const Coordinate kSlicePermutation;

/// Turns that keep twist, flips and slice: all turns of U and D, half turns of the others.
inline constexpr std::array<Move, 10> kSecondPhaseMoves{
    Move{Face::U, 1}, Move{Face::U, 2}, Move{Face::U, 3}, Move{Face::R, 2}, Move{Face::F, 2},
    Move{Face::D, 1}, Move{Face::D, 2}, Move{Face::D, 3}, Move{Face::L, 2}, Move{Face::B, 2}};
/// All turns, in the order of their numbers.
[[nodiscard]] std::span<const Move> all_moves();

/// @return [value * moves.size() + k]: the number after turn moves[k]
[[nodiscard]] std::vector<std::uint16_t> move_table(const Coordinate& coordinate,
                                                    std::span<const Move> moves);
/// @return [value * 16 + s]: the number seen through symmetry s
[[nodiscard]] std::vector<std::uint16_t> symmetry_table(const Coordinate& coordinate);

/// Values that symmetries turn into each other make a class.
struct SymmetryClasses {
  /// Where a value belongs: 16 * class + s, where symmetry s leads from the value to the representative.
  std::vector<std::uint32_t> member_of;
  std::vector<std::uint32_t> representative;  ///< of each class
  /// Of each class, bit s: symmetry s keeps the representative as it is.
  std::vector<std::uint16_t> stabiliser;

  /// Numbers the classes by their least values, in ascending order.
  explicit SymmetryClasses(const Coordinate& coordinate);
  /// @return number of classes
  [[nodiscard]] int size() const { return static_cast<int>(representative.size()); }
};

/// @return [class * moves.size() + k]: 16 * class + s after turn moves[k] of the representative
[[nodiscard]] std::vector<std::uint32_t> class_move_table(const Coordinate& coordinate,
                                                          const SymmetryClasses& classes,
                                                          std::span<const Move> moves);

}  // namespace mrroc::rubik
