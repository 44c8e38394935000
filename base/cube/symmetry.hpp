// The 48 symmetries of the cube's body: rotations and reflections that map it to itself.
#pragma once
#include <array>
#include <cstdint>

#include "base/cube/cube.hpp"

namespace mrroc::cube {

/// Number of the symmetries: 24 rotations, and as many reflections.
inline constexpr int kSymmetries = 48;
/// The first so many keep the axis through U and D; among themselves they are a group.
inline constexpr int kAxisSymmetries = 16;

/// A symmetry as what it does to faces, slots and stickers.
struct Symmetry {
  std::array<Face, kFaces> faces{};                    ///< where each face goes
  bool mirrored{};                                     ///< a reflection: clockwise becomes counterclockwise
  std::array<std::uint8_t, kCorners> corner{};         ///< where each corner slot goes
  std::array<std::uint8_t, kCorners> corner_offset{};  ///< on which sticker of it sticker 0 goes
  std::array<std::uint8_t, kEdges> edge{};             ///< where each edge slot goes
  std::array<std::uint8_t, kEdges> edge_offset{};      ///< on which sticker of it sticker 0 goes
};

/// @return symmetry s, 0 to 47; number 0 is the identity. The table is made at the first call.
[[nodiscard]] const Symmetry& symmetry(int s);
/// @return the symmetry that does b first, then a
[[nodiscard]] int compose(int a, int b);
/// @return the symmetry that undoes s
[[nodiscard]] int inverse_symmetry(int s);
/// @return the rotation by 120 degrees about the corner URF, applied so many times: it brings the axes through U,
///         R and F to each other's place
[[nodiscard]] int axis_rotation(int times);
/// @return the rotation by 90 degrees clockwise about a face, as seen from outside
[[nodiscard]] Symmetry rotation_about(Face face);

/// @return the cube seen through the symmetry: s cube s^-1, with pieces and slots renamed. It solves in as many
///         turns; conjugate(a * b, s) == conjugate(a, s) * conjugate(b, s)
[[nodiscard]] Cube conjugate(const Cube& cube, const Symmetry& s);

}  // namespace mrroc::cube
