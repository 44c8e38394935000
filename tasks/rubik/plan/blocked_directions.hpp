// Records which faces of a cube do not turn in which direction.
#pragma once
#include <array>

#include "base/cube/move.hpp"
#include "tasks/rubik/cube/names.hpp"

namespace mrroc::rubik {

/// Findings about the faces of one cube.
class BlockedDirections {
 public:
  /// @param direction  of the face, positive: clockwise seen from outside; its size does not matter
  constexpr void add(Face face, double direction) { at(face)[direction > 0 ? 0 : 1] = true; }
  /// @return whether that has been added; the same direction
  [[nodiscard]] constexpr bool has(Face face, double direction) const {
    return blocked_[static_cast<std::size_t>(number(face))][direction > 0 ? 0 : 1];
  }

 private:
  constexpr std::array<bool, 2>& at(Face face) { return blocked_[static_cast<std::size_t>(number(face))]; }

  std::array<std::array<bool, 2>, kFaces> blocked_{};
};

/// Way of doing a turn of a face.
struct TurnDirection {
  int quarters{};           ///< clockwise: 1, -1, 2, or where the face jams -3, 3, -2
  bool either_direction{};  ///< of a half turn: the other direction does as well
};

/// @return the shortest turn that does not go in a direction in which the face jams; one that jams in both is turned
///         as if it jammed in none
[[nodiscard]] constexpr TurnDirection direction_of(Move move, const BlockedDirections& known) {
  const int usual = move.quarters() == 3 ? -1 : move.quarters();
  const bool blocked = known.has(move.face(), usual), others = known.has(move.face(), -usual);
  const bool half = usual == 2;
  if (!blocked || others) return {usual, half && blocked == others};
  return {usual > 0 ? usual - 4 : usual + 4, false};
}

}  // namespace mrroc::rubik
