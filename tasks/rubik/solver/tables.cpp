#include "tasks/rubik/solver/tables.hpp"

#include <fmt/core.h>

#include "tasks/rubik/solver/coset_space.hpp"
#include "tasks/rubik/solver/first_phase_moves.hpp"
#include "tasks/rubik/solver/table_builder.hpp"

namespace mrroc::rubik {
namespace {

/// Increase this when the content of a table changes.
constexpr std::uint32_t kVersion = 1;

/// Longest distances that are told apart. In a search of the first phase for n turns, longer ones would cut only
/// nodes at depth n - 10 or less, which are few; in the second phase longer ends are not searched.
struct Depths {
  int phase1, phase2, corners;
};
constexpr int kAll = 14;
constexpr Depths kSmall{7, 8, 6};
constexpr Depths kStandard{9, 11, kAll};

/// Opens or makes one table after the other.
class Opener {
 public:
  using Fill = std::function<void(std::span<std::uint8_t>, const Progress&)>;

  Opener(const std::filesystem::path& folder, int threads, const TableWatch& watch)
      : folder_(folder), threads_(threads), watch_(watch) {}

  OpenTable open(const std::string& name, std::size_t bytes, const Fill& fill) const {
    const auto watched = [&](std::span<std::uint8_t> memory) {
      const auto report = [&](double part) {
        if (watch_.progress) watch_.progress(name, part);
      };
      report(0);
      fill(memory, report);
      report(1);
    };
    if (folder_.empty()) {
      OpenTable table{Memory(bytes), TableSource::unwritten, {}};
      watched(table.memory.writable());
      return table;
    }
    OpenTable table = open_table(folder_, {name, kVersion, bytes}, watched);
    if (!table.failure_reason.empty() && watch_.notice)
      watch_.notice(table.source == TableSource::unwritten
                        ? fmt::format("table {} could not be kept: {}", name, table.failure_reason)
                        : fmt::format("table {} was made again: {}", name, table.failure_reason));
    return table;
  }

  /// @param space  makes the coset space, when the table has to be filled
  template <int Bits, class Space>
  OpenTable open(const std::string& name, const PackedLayout<Bits>& layout, int pages, int deepest,
                 Space space) const {
    return open(name, layout.bytes(pages), [&](std::span<std::uint8_t> bytes, const Progress& progress) {
      build_table<Bits>(space(), bytes, deepest, threads_, progress);
    });
  }

 private:
  const std::filesystem::path& folder_;
  int threads_;
  const TableWatch& watch_;
};

std::vector<std::uint8_t> make_moves_seen() {
  std::vector<std::uint8_t> table;
  for (const Move m : all_moves())
    for (int s = 0; s < kAxisSymmetries; ++s) table.push_back(conjugate(m, symmetry(s)).index);
  return table;
}

std::vector<std::uint32_t> make_followers_seen() {
  std::vector<std::uint32_t> table;
  for (const Move last : all_moves())
    for (int s = 0; s < kAxisSymmetries; ++s) {
      table.push_back(0);
      for (const Move m : all_moves())
        if (may_follow(&last, m)) table.back() |= 1U << conjugate(m, symmetry(s)).index;
    }
  return table;
}

std::vector<std::uint8_t> make_symmetry_product() {
  std::vector<std::uint8_t> table;
  for (int a = 0; a < kAxisSymmetries; ++a)
    for (int b = 0; b < kAxisSymmetries; ++b) table.push_back(static_cast<std::uint8_t>(compose(a, b)));
  return table;
}

}  // namespace

Tables::Tables(TableSet set, const std::filesystem::path& folder, int threads, const TableWatch& watch)
    : flip_slices(kFlipSlice),
      corner_permutations(kCornerPermutation),
      flip_slice_moves(class_move_table(kFlipSlice, flip_slices, all_moves())),
      twist_moves(move_table(kTwist, all_moves())),
      twist_seen(symmetry_table(kTwist)),
      tetrad_seen(symmetry_table(kTetrad)),
      edge_permutation_seen(symmetry_table(kEdgePermutation)),
      slice_permutation_seen(symmetry_table(kSlicePermutation)),
      corner_permutation_moves(move_table(kCornerPermutation, kSecondPhaseMoves)),
      edge_permutation_moves(move_table(kEdgePermutation, kSecondPhaseMoves)),
      slice_permutation_moves(move_table(kSlicePermutation, kSecondPhaseMoves)),
      moves_seen(make_moves_seen()),
      followers_seen(make_followers_seen()),
      symmetry_product(make_symmetry_product()) {
  entrances = Entrances(*this);
  const Depths depths = set == TableSet::small ? kSmall : kStandard;
  const std::string_view suffix = set == TableSet::small ? "-small" : "";
  const auto space = [](const Coordinate& page, const SymmetryClasses& classes, const Coordinate* row,
                        const Coordinate& column, std::span<const Move> moves) {
    return [&page, &classes, row, &column, moves] { return CosetSpace(page, classes, row, column, moves); };
  };
  const Opener opener(folder, threads, watch);
  corner_slice_ = opener.open(
      "corner-slice", kCornerSlice, corner_permutations.size(), kAll,
      space(kCornerPermutation, corner_permutations, nullptr, kSlicePermutation, kSecondPhaseMoves));
  corners_ =
      opener.open(fmt::format("corners{}", suffix), kCornerTwists, corner_permutations.size(), depths.corners,
                  space(kCornerPermutation, corner_permutations, nullptr, kTwist, all_moves()));
  phase2_ = opener.open(
      fmt::format("phase2{}", suffix), kPhase2, corner_permutations.size(), depths.phase2,
      space(kCornerPermutation, corner_permutations, nullptr, kEdgePermutation, kSecondPhaseMoves));
  phase1_ = opener.open(fmt::format("phase1{}", suffix), kPhase1, flip_slices.size(), depths.phase1,
                        space(kFlipSlice, flip_slices, nullptr, kTwist, all_moves()));
  if (set != TableSet::large) return;
  move_words_ =
      opener.open("move-words", sizeof(std::uint32_t) * kTwists * flip_slices.size(),
                  [&](std::span<std::uint8_t> bytes, const Progress& progress) {
                    const std::span words(reinterpret_cast<std::uint32_t*>(bytes.data()),
                                          bytes.size() / sizeof(std::uint32_t));
                    build_move_words(CosetSpace(kFlipSlice, flip_slices, nullptr, kTwist, all_moves()),
                                     phase1_.memory.data(), words, threads, progress);
                  });
  large_ = opener.open("large", kLarge, flip_slices.size(), kAll,
                       space(kFlipSlice, flip_slices, &kTetrad, kTwist, all_moves()));
}

}  // namespace mrroc::rubik
