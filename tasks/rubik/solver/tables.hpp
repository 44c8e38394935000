// All tables of the solvers.
#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/rubik/solver/coordinates.hpp"
#include "tasks/rubik/solver/entrances.hpp"
#include "tasks/rubik/solver/packed_table.hpp"
#include "tasks/rubik/solver/table_file.hpp"

namespace mrroc::rubik {

/// Size of the tables.
enum class TableSet : std::uint8_t {
  small,     ///< as standard, but only short distances are told apart: made in a moment, for tests
  standard,  ///< 130 MB, made in a few seconds
  large      ///< 3.2 GB, made in minutes: much faster optimal solutions, shorter ones in the same time
};

/// Callbacks while tables are opened. Either may be empty.
struct TableWatch {
  std::function<void(std::string_view table, double part)>
      progress;                                         ///< a table is being filled; part 0 to 1
  std::function<void(const std::string& text)> notice;  ///< a file was damaged, or cannot be written
};

/// A state of the first phase: flips and slice as a class of kFlipSlice and the symmetry that leads to its
/// representative, twist as seen through this symmetry.
struct CosetState {
  std::uint32_t flip_slice_class;  ///< number of the class
  std::uint16_t twist;             ///< of kTwist, seen so
  std::uint8_t symmetry;           ///< 0 to 15
};

/// Bounds and successors that every solver shares; read-only, any number of threads may use it.
///
/// The group that the second phase searches: cubes that only kSecondPhaseMoves solve.
class Tables {
 public:
  /// Opens the tables, and makes those that are missing or damaged.
  /// @param folder  where the files are; empty: nothing is kept
  /// @param threads  for making them, at least 1
  Tables(TableSet set, const std::filesystem::path& folder, int threads, const TableWatch& watch = {});

  SymmetryClasses flip_slices;          ///< of kFlipSlice
  SymmetryClasses corner_permutations;  ///< of kCornerPermutation
  /// Successors by class_move_table() or move_table(), all turns
  std::vector<std::uint32_t> flip_slice_moves;
  std::vector<std::uint16_t> twist_moves;
  /// by symmetry_table()
  std::vector<std::uint16_t> twist_seen, tetrad_seen, edge_permutation_seen, slice_permutation_seen;
  /// Successors by move_table(), kSecondPhaseMoves
  std::vector<std::uint16_t> corner_permutation_moves, edge_permutation_moves, slice_permutation_moves;
  /// 16 * turn + s: the turn seen through s
  std::vector<std::uint8_t> moves_seen;
  /// 16 * turn + s: mask of the turns that may follow it, both seen through s
  std::vector<std::uint32_t> followers_seen;
  /// 16 * a + b: symmetry b, then a
  std::vector<std::uint8_t> symmetry_product;

  Entrances entrances;  ///< into the second phase's group

  /// @return state of the cube
  [[nodiscard]] CosetState state_of(const Cube& cube) const {
    const std::uint32_t member = flip_slices.member_of[kFlipSlice.of(cube)];
    const auto s = static_cast<std::uint8_t>(member % kAxisSymmetries);
    return {member / kAxisSymmetries, twist_seen[kTwist.of(cube) * kAxisSymmetries + s], s};
  }
  /// @param seen_turn  as seen through the state's symmetry
  /// @return state after the turn
  [[nodiscard]] CosetState after(const CosetState& s, int seen_turn) const {
    const std::uint32_t member = flip_slice_moves[s.flip_slice_class * kMoves + seen_turn];
    const std::uint32_t further = member % kAxisSymmetries;
    const unsigned twist = twist_moves[s.twist * kMoves + seen_turn];
    return {member / kAxisSymmetries, twist_seen[twist * kAxisSymmetries + further],
            symmetry_product[further * kAxisSymmetries + s.symmetry]};
  }

  /// @return turns to the second phase's group, exact or at least so many
  [[nodiscard]] unsigned phase1(std::uint32_t flip_slice_class, unsigned twist_seen_so) const {
    return get_packed<4>(phase1_.memory.data() + flip_slice_class * kPhase1.page_bytes(), twist_seen_so);
  }
  /// @return at least so many turns to solve corners and edges of U and D, within the group
  [[nodiscard]] unsigned phase2(std::uint32_t corner_class, unsigned edges_seen_so) const {
    return get_packed<4>(phase2_.memory.data() + corner_class * kPhase2.page_bytes(), edges_seen_so);
  }
  /// @return the byte that phase2() would read
  [[nodiscard]] const std::uint8_t* phase2_address(std::uint32_t corner_class, unsigned edges_seen_so) const {
    return phase2_.memory.data() + corner_class * kPhase2.page_bytes() + edges_seen_so / 2;
  }
  /// @return turns to solve corners and edges of the slice, within the group
  [[nodiscard]] unsigned corner_slice(std::uint32_t corner_class, unsigned slice_seen_so) const {
    return get_packed<4>(corner_slice_.memory.data() + corner_class * kCornerSlice.page_bytes(),
                         slice_seen_so);
  }
  /// @return turns to solve the corners: the pattern database of Korf (1997)
  [[nodiscard]] unsigned corners(std::uint32_t corner_class, unsigned twist_seen_so) const {
    return get_packed<4>(corners_.memory.data() + corner_class * kCornerTwists.page_bytes(), twist_seen_so);
  }
  /// @return whether there is the large table
  [[nodiscard]] bool has_large() const { return large_.memory.data() != nullptr; }
  /// @return the row of the large table with the bounds that its columns, twists, give
  [[nodiscard]] const std::uint8_t* large_row(std::uint32_t flip_slice_class, unsigned tetrad_seen_so) const {
    return large_.memory.data() + flip_slice_class * kLarge.page_bytes() +
           tetrad_seen_so * kLarge.row_bytes();
  }
  /// @return whether there are move words
  [[nodiscard]] bool has_move_words() const { return move_words_.memory.data() != nullptr; }
  /// @return the MoveWord of a state of the first phase
  [[nodiscard]] const std::uint32_t* move_word_address(std::uint32_t flip_slice_class,
                                                       unsigned twist_seen_so) const {
    return reinterpret_cast<const std::uint32_t*>(move_words_.memory.data()) +
           flip_slice_class * std::size_t{kTwists} + twist_seen_so;
  }
  /// @return the byte that phase1() would read
  [[nodiscard]] const std::uint8_t* phase1_address(std::uint32_t flip_slice_class,
                                                   unsigned twist_seen_so) const {
    return phase1_.memory.data() + flip_slice_class * kPhase1.page_bytes() + twist_seen_so / 2;
  }

 private:
  static constexpr PackedLayout<4> kPhase1{1, kTwists};
  static constexpr PackedLayout<4> kPhase2{1, kPermutations};
  static constexpr PackedLayout<4> kCornerSlice{1, kSlicePermutations};
  static constexpr PackedLayout<4> kCornerTwists{1, kTwists};
  static constexpr PackedLayout<2> kLarge{kTetrads, kTwists};

  OpenTable phase1_, phase2_, corner_slice_, corners_, move_words_, large_;
};

}  // namespace mrroc::rubik
