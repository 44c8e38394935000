// The ways in which a hand holds the cube.
#pragma once
#include <array>
#include <cstdint>
#include <string>

#include "base/cube/cube.hpp"
#include "base/pose.hpp"

namespace mrroc::cube {

/// The hands of the cell, in the order of the simulator's arms. The fingers of the arm on the pedestal cover
/// one layer of the cube, those of the arm on the track two: the postument keeps a face, the track arm turns
/// the rest.
enum class Hand : std::uint8_t { postument, track };
/// Both, by index().
inline constexpr std::array kHands{Hand::postument, Hand::track};
/// @return index of the hand's arm
[[nodiscard]] constexpr std::size_t index(Hand hand) { return static_cast<std::size_t>(hand); }
/// @return the hand that is not this one
[[nodiscard]] constexpr Hand other(Hand hand) {
  return hand == Hand::postument ? Hand::track : Hand::postument;
}

/// A firm grip, as seen by the cube's core: the frame C has x out of face R, y out of B, z out of U. Turns of faces
/// leave the core where it is, but for the turn of the face that the postument holds: then the core goes with the
/// track arm.
struct Grasp {
  Hand hand{Hand::track};  ///< that has the cube
  Face palm{Face::D};      ///< on which the palm lies: the one at -z of E
  Face jaw{Face::B};       ///< on which the finger at +y of E lies; perpendicular to palm

  friend constexpr bool operator==(const Grasp&, const Grasp&) = default;
};

/// Edge of the cube: the distance between jaws that hold it [m].
inline constexpr double kEdge = 0.057;

/// Depth of a grip: how far E is from the middle of the cube, towards the arm, when the palm lies on the cube [m].
[[nodiscard]] constexpr double depth(Hand hand) { return hand == Hand::postument ? 0.019 : 0.0095; }

/// @return out of the face, in C
[[nodiscard]] Vector3 normal(Face face);
/// @return the face whose normal is nearest to the direction, given in C
[[nodiscard]] Face face_along(const Vector3& direction);
/// @return face whose normal is a x b; a and b are perpendicular
[[nodiscard]] Face cross(Face a, Face b);

/// @return whether palm and jaw are perpendicular
[[nodiscard]] bool is_valid(const Grasp& grasp);
/// @return T_EC of the cube in the hand
[[nodiscard]] Pose cube_in_hand(const Grasp& grasp);
/// @return the grasp of a hand with E so turned against the core; turns are rounded to quarters
[[nodiscard]] Grasp grasp_from(Hand hand, const Matrix3& R_EC);
/// @param quarters  by which the hand has turned about its z, positive: counterclockwise seen against z
/// @return the grasp of the same hand that holds the core where it was
[[nodiscard]] Grasp turned(const Grasp& grasp, int quarters);

/// @return e.g. "track D/B": hand, palm, jaw
[[nodiscard]] std::string to_string(const Grasp& grasp);

}  // namespace mrroc::cube
