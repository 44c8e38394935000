#include "tasks/rubik/solver/coset_space.hpp"

namespace mrroc::rubik {
namespace {

/// @return [(turn * 16 + s) * size + value]: the value after the turn, seen through s
std::vector<std::uint16_t> compose_maps(const Coordinate& coordinate, std::span<const Move> moves,
                                        const std::vector<std::uint16_t>& seen) {
  const std::vector<std::uint16_t> moved = move_table(coordinate, moves);
  std::vector<std::uint16_t> maps;
  maps.reserve(moved.size() * kAxisSymmetries);
  for (std::size_t k = 0; k < moves.size(); ++k)
    for (int s = 0; s < kAxisSymmetries; ++s)
      for (int value = 0; value < coordinate.size; ++value)
        maps.push_back(seen[moved[value * moves.size() + k] * kAxisSymmetries + s]);
  return maps;
}

}  // namespace

CosetSpace::CosetSpace(const Coordinate& page, const SymmetryClasses& classes, const Coordinate* row,
                       const Coordinate& column, std::span<const Move> moves)
    : page_(&page),
      classes_(&classes),
      row_(row),
      column_(&column),
      rows_(row != nullptr ? row->size : 1),
      columns_(column.size),
      moves_(static_cast<int>(moves.size())),
      steps_(class_move_table(page, classes, moves)),
      stabiliser_(classes.stabiliser),
      row_seen_(row != nullptr ? symmetry_table(*row) : std::vector<std::uint16_t>(kAxisSymmetries, 0)),
      column_seen_(symmetry_table(column)),
      row_maps_(row != nullptr ? compose_maps(*row, moves, row_seen_)
                               : std::vector<std::uint16_t>(moves.size() * kAxisSymmetries, 0)),
      column_maps_(compose_maps(column, moves, column_seen_)) {}

CosetSpace::Place CosetSpace::place_of(const Cube& cube) const {
  const std::uint32_t member = classes_->member_of[page_->of(cube)];
  const int s = static_cast<int>(member % kAxisSymmetries);
  return {static_cast<int>(member / kAxisSymmetries), row_ != nullptr ? row_seen(row_->of(cube), s) : 0,
          column_seen(column_->of(cube), s)};
}

}  // namespace mrroc::rubik
