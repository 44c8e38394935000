// Turns of a face, sequences of them and their notation: "R U' F2".
#pragma once
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "base/cube/cube.hpp"
#include "base/cube/symmetry.hpp"

namespace mrroc::cube {

inline constexpr int kMoves = 18;  ///< turns of six faces by one, two or three quarters

/// One turn of one face.
struct Move {
  std::uint8_t index{};  ///< 3 * face + quarter turns - 1

  constexpr Move() = default;
  /// @param move  its number, 0..17
  constexpr explicit Move(int move) : index(static_cast<std::uint8_t>(move)) {}
  /// @param quarters  clockwise quarter turns seen from outside, 1 to 3
  constexpr Move(Face face, int quarters) : Move(3 * number(face) + quarters - 1) {}

  /// @return the face that is turned
  [[nodiscard]] constexpr Face face() const { return static_cast<Face>(index / 3); }
  /// @return clockwise quarter turns, 1 to 3
  [[nodiscard]] constexpr int quarters() const { return index % 3 + 1; }
  /// @return the turn that undoes this one
  [[nodiscard]] constexpr Move inverse() const { return {face(), 4 - quarters()}; }
  friend constexpr bool operator==(const Move&, const Move&) = default;
};
using Moves = std::vector<Move>;  ///< in the order of execution

/// @return the solved cube after the turn, i.e. the turn as a permutation: cube * turn(m) is cube after m. The
///         table is made at the first call.
[[nodiscard]] const Cube& turn(Move m);
/// @return the cube after the turns, in their order
[[nodiscard]] Cube after(Cube cube, const Moves& moves);
/// @return the turns that undo these
[[nodiscard]] Moves inverse(const Moves& moves);
/// @return the turn that m becomes seen through the symmetry: turn(conjugate(m, s)) == conjugate(turn(m), s)
[[nodiscard]] Move conjugate(Move m, const Symmetry& s);

/// Which turns may follow which without repeating what is searched anyway: never the same face twice, and of two
/// opposite faces U, R or F first.
/// @param last  the turn before; nullptr stands for none
[[nodiscard]] constexpr bool may_follow(const Move* last, Move m) {
  if (last == nullptr) return true;
  return m.face() != last->face() && (m.face() != opposite(last->face()) || number(m.face()) > 2);
}

/// @return "R U' F2"
[[nodiscard]] std::string to_string(Move m);
[[nodiscard]] std::string to_string(const Moves& moves);
/// Reads turns separated by spaces or commas, or by nothing: a letter of URFDLB, then 2, ' or 3 (as '), 2'.
/// An apostrophe may be typeset, or a prime.
/// @throws FaultError bad_cube, naming what is no turn
[[nodiscard]] Moves parse_moves(std::string_view text);

/// @return a uniformly random reachable cube
[[nodiscard]] Cube random_cube(std::mt19937_64& random);
/// @return so many random turns, none of which may_follow() refuses
[[nodiscard]] Moves random_moves(int count, std::mt19937_64& random);

}  // namespace mrroc::cube
