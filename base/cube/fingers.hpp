// The fingers of a gripper that holds a cube: the number of layers that they cover, and their shape.
#pragma once
#include <cstdint>

#include "base/cube/grasp.hpp"

namespace mrroc::cube {

/// Number of a cube's layers that the fingers of a gripper cover.
enum class Fingers : std::uint8_t { one_layer, two_layers };

/// @return depth of a grip: how far E is from the middle of the cube, towards the arm, when the palm lies on the cube [m]
[[nodiscard]] constexpr double depth(Fingers fingers) {
  return depth(fingers == Fingers::one_layer ? Hand::postument : Hand::track);
}

/// Parts of a two-jaw gripper that can touch things. The gripper's frame is E: midway between the pads, y
/// along their motion, z out of the hand.
struct GripperShape {
  double pad_width{0.05};      ///< along x [m]
  double pad_depth{0.015};     ///< along z [m]
  double pad_thickness{0.01};  ///< along y [m]
  double palm{0.0095};         ///< from E back to the palm, against which a cube's face rests [m]
  double palm_width{0.024};    ///< edge of the square palm [m]
};

/// @return a gripper with such fingers, whose palm lies on the cube when they cover it
[[nodiscard]] GripperShape gripper_with(Fingers fingers);

/// @param face  that points away from the palm
/// @return T_MC of a cube that is held so, in the frame M whose z comes out of that face
[[nodiscard]] Pose cube_with(Face face);

/// @param face  that points away from the palm
/// @return T_EC of a cube in such a hand
[[nodiscard]] Pose cube_in_hand(Fingers fingers, Face face);

}  // namespace mrroc::cube
