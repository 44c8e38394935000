// Which faces of a cube do not turn in which direction.
#pragma once
#include <array>

#include "tasks/rubik/cube/move.hpp"

namespace mrroc::rubik {

/// What has been found out about the faces of one cube.
class Jams {
 public:
  /// @param direction  of the face, positive: clockwise seen from outside; its size does not matter
  constexpr void add(Face face, double direction) { at(face)[direction > 0 ? 0 : 1] = true; }
  /// @return whether that has been added; the same direction
  [[nodiscard]] constexpr bool has(Face face, double direction) const {
    return jams_[static_cast<std::size_t>(number(face))][direction > 0 ? 0 : 1];
  }

 private:
  constexpr std::array<bool, 2>& at(Face face) { return jams_[static_cast<std::size_t>(number(face))]; }

  std::array<std::array<bool, 2>, kFaces> jams_{};
};

/// How a turn of a face is done.
struct TurnWay {
  int quarters{};     ///< clockwise: 1, -1, 2, or where the face jams -3, 3, -2
  bool either_way{};  ///< of a half turn: the other direction does as well
};

/// @return the shortest way that does not go in a direction in which the face jams; one that jams in both is turned
///         as if it jammed in none
[[nodiscard]] constexpr TurnWay way_of(Move move, const Jams& jams) {
  const int usual = move.quarters() == 3 ? -1 : move.quarters();
  const bool blocked = jams.has(move.face(), usual), others = jams.has(move.face(), -usual);
  const bool half = usual == 2;
  if (!blocked || others) return {usual, half && blocked == others};
  return {usual > 0 ? usual - 4 : usual + 4, false};
}

}  // namespace mrroc::rubik
