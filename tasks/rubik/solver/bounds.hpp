// Lower bounds of the number of turns that solve a cube, from the pruning tables.
#pragma once
#include <array>
#include <cstdint>

#include "base/cube/cube.hpp"
#include "tasks/rubik/cube/names.hpp"
#include "tasks/rubik/solver/fast_cube.hpp"
#include "tasks/rubik/solver/table_builder.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// A cube seen along each of its three axes gives three bounds, its inverse three more.
inline constexpr int kViews = 6;
inline constexpr int kAxes = 3;  ///< of a cube

/// The coordinates of a cube along its three axes, packed.
struct AxisCoordinates {
  std::uint64_t corners;  ///< twists, and slots of the tetrad
  std::uint64_t edges;    ///< flips, and slots of two slices
};

/// Indices of a view into the tables.
struct Probe {
  std::uint32_t flip_slice_class;  ///< page of the tables
  std::uint32_t twist;             ///< seen through the class's symmetry
  const std::uint8_t* large_row;   ///< of the large table; null: there is none
};

/// Bounds by views. Reads shared tables only.
class Bounds {
 public:
  /// @param tables  outlives this object
  explicit Bounds(const Tables& tables);

  /// @return as given to the constructor
  [[nodiscard]] const Tables& tables() const { return tables_; }

  /// @return the coordinates along all axes, as sums over slots
  [[nodiscard]] AxisCoordinates coordinates(const Cube& cube) const {
    AxisCoordinates sum{0, 0};
    for (int k = 0; k < kCorners; ++k) sum.corners += corner_terms_[k][cube.corners[k]];
    for (int k = 0; k < kEdges; ++k) sum.edges += edge_terms_[k][cube.edges[k]];
    return sum;
  }

  /// @return where the view along the axis, 0 to 2, looks; the memory there is on its way
  [[nodiscard]] Probe probe(const AxisCoordinates& c, int axis) const {
    const auto first = static_cast<unsigned>(c.edges >> kSliceShift[0]) & 0xfff;
    const auto second = static_cast<unsigned>(c.edges >> kSliceShift[1]) & 0xfff;
    const unsigned slice = axis == 0 ? first : axis == 1 ? second : ~(first | second) & 0xfff;
    const unsigned flips = static_cast<unsigned>(c.edges >> (kField * axis)) & (kFlips - 1);
    const std::uint32_t member = tables_.flip_slices.member_of[slice_ranks_[axis][slice] * kFlips + flips];
    const std::uint32_t s = member % kAxisSymmetries;
    const auto twist = static_cast<unsigned>(c.corners >> (kField * axis)) & 0xfff;
    Probe p{member / kAxisSymmetries, tables_.twist_seen[twist * kAxisSymmetries + s], nullptr};
    if (large_) {
      const auto mask = static_cast<unsigned>(c.corners >> (kTetradShift + kTetradField * axis)) & 0xff;
      p.large_row = tables_.large_row(p.flip_slice_class,
                                      tables_.tetrad_seen[tetrad_ranks_[mask] * kAxisSymmetries + s]);
      __builtin_prefetch(p.large_row + p.twist / 4);
    } else {
      __builtin_prefetch(tables_.phase1_address(p.flip_slice_class, p.twist));
    }
    return p;
  }

  /// @param enough  bounds up to this need not be told apart
  /// @return a number of turns below which the cube cannot be solved, or at most enough
  [[nodiscard]] int bound(const Probe& p, int enough) const {
    if (large_) {
      const int beyond = static_cast<int>(get_packed<2>(p.large_row, p.twist));
      if (beyond > 0 || enough >= kTwoBitBase) return kTwoBitBase + beyond;
    }
    return static_cast<int>(tables_.phase1(p.flip_slice_class, p.twist));
  }

  /// @return turns that solve the corners alone
  [[nodiscard]] int corner_bound(const Cube& cube) const;
  /// @return the largest of all bounds, below which the cube cannot be solved
  [[nodiscard]] int lower_bound(const CubePair& pair) const;
  /// @return the largest bound that there is
  [[nodiscard]] int largest() const { return large_ ? kTwoBitBase + 3 : 11; }

 private:
  // Fields of AxisCoordinates: twists (12 bits each), then masks of the tetrad's slots; flips, then masks of two
  // slices' slots - the third slice has the slots that are left.
  static constexpr int kField = 12;
  static constexpr int kTetradShift = 36;
  static constexpr int kTetradField = 8;
  static constexpr std::array<int, 2> kSliceShift{36, 48};

  const Tables& tables_;
  bool large_;
  std::array<std::array<std::uint64_t, kCornerValues>, kCorners> corner_terms_{};
  std::array<std::array<std::uint64_t, kEdgeValues>, kEdges> edge_terms_{};
  std::array<std::array<std::uint16_t, 1 << kEdges>, kAxes> slice_ranks_{};  ///< by mask of real slots
  std::array<std::uint8_t, 1 << kCorners> tetrad_ranks_{};
};

}  // namespace mrroc::rubik
