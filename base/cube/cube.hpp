// The cube as a group: the slot of every piece, and its orientation there.
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace mrroc::cube {

/// The six faces, in the order of the facelets. Opposite faces are three apart.
// NOLINTNEXTLINE(readability-identifier-naming): the letters of the notation
enum class Face : std::uint8_t { U, R, F, D, L, B };
inline constexpr int kFaces = 6;  ///< of a cube

/// @return the number of the face, 0 to 5
[[nodiscard]] constexpr int number(Face f) { return static_cast<int>(f); }
/// @return the face opposite to f
[[nodiscard]] constexpr Face opposite(Face f) { return static_cast<Face>((number(f) + 3) % 6); }
/// Letters of the faces in their order.
inline constexpr std::string_view kFaceLetters = "URFDLB";
/// @return the letter of the face
[[nodiscard]] constexpr char letter(Face f) { return kFaceLetters[static_cast<std::size_t>(number(f))]; }

/// Slots for corners and for edges, and as many pieces.
inline constexpr int kCorners = 8;
inline constexpr int kEdges = 12;

/// Faces of each corner slot, clockwise seen from outside, beginning with U or D; the piece at home in a slot
/// has the slot's number.
inline constexpr std::array<std::array<Face, 3>, kCorners> kCornerFaces{{
    {Face::U, Face::R, Face::F},
    {Face::U, Face::F, Face::L},
    {Face::U, Face::L, Face::B},
    {Face::U, Face::B, Face::R},
    {Face::D, Face::F, Face::R},
    {Face::D, Face::L, Face::F},
    {Face::D, Face::B, Face::L},
    {Face::D, Face::R, Face::B},
}};
/// Faces of each edge slot, beginning with U or D, else with F or B.
inline constexpr std::array<std::array<Face, 2>, kEdges> kEdgeFaces{{
    {Face::U, Face::R},
    {Face::U, Face::F},
    {Face::U, Face::L},
    {Face::U, Face::B},
    {Face::D, Face::R},
    {Face::D, Face::F},
    {Face::D, Face::L},
    {Face::D, Face::B},
    {Face::F, Face::R},
    {Face::F, Face::L},
    {Face::B, Face::L},
    {Face::B, Face::R},
}};

/// A state of the cube, and at the same time the permutation that leads to it from the solved one. Any
/// assembly can be held, also one that turns cannot reach (is_reachable()).
struct Cube {
  /// Content of corner slot k: 3 * piece + twist. Sticker j of the piece is on face (j + twist) mod 3 of the
  /// slot.
  std::array<std::uint8_t, kCorners> corners{0, 3, 6, 9, 12, 15, 18, 21};
  /// Content of edge slot k: 2 * piece + flip.
  std::array<std::uint8_t, kEdges> edges{0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22};

  friend constexpr bool operator==(const Cube&, const Cube&) = default;
};

/// Values a corner slot or an edge slot can have.
inline constexpr int kCornerValues = 24;
inline constexpr int kEdgeValues = 24;

/// @return a followed by b: what is in slot k of the result came through slot b_k of a
[[nodiscard]] constexpr Cube operator*(const Cube& a, const Cube& b) {
  Cube c;
  for (int k = 0; k < kCorners; ++k) {
    const int from = a.corners[b.corners[k] / 3];
    c.corners[k] = static_cast<std::uint8_t>(from / 3 * 3 + (from % 3 + b.corners[k] % 3) % 3);
  }
  for (int k = 0; k < kEdges; ++k)
    c.edges[k] = static_cast<std::uint8_t>(a.edges[b.edges[k] / 2] ^ (b.edges[k] & 1));
  return c;
}

/// @return the cube that undoes a: a * inverse(a) is solved
[[nodiscard]] constexpr Cube inverse(const Cube& a) {
  Cube c;
  for (int k = 0; k < kCorners; ++k)
    c.corners[a.corners[k] / 3] = static_cast<std::uint8_t>(3 * k + (3 - a.corners[k] % 3) % 3);
  for (int k = 0; k < kEdges; ++k)
    c.edges[a.edges[k] / 2] = static_cast<std::uint8_t>(2 * k + (a.edges[k] & 1));
  return c;
}

/// @return sum of the corners' twists modulo 3; 0 for every cube that turns can reach
[[nodiscard]] int twist_sum(const Cube& cube);
/// @return sum of the edges' flips modulo 2; 0 for every cube that turns can reach
[[nodiscard]] int flip_sum(const Cube& cube);
/// @return whether the corners' permutation is odd
[[nodiscard]] bool odd_corners(const Cube& cube);
/// @return whether the edges' permutation is odd
[[nodiscard]] bool odd_edges(const Cube& cube);
/// @param cube  a permutation of the pieces
/// @return whether turns of the faces lead from the solved cube to this one
[[nodiscard]] bool is_reachable(const Cube& cube);

}  // namespace mrroc::cube
