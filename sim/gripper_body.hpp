// The body of a two-jaw gripper in contacts: fingers with pads, a palm, and the elastic wrist that bears
// them.
#pragma once
#include "base/cube/fingers.hpp"

namespace mrroc::sim {

/// Masses are part of the
/// tool's: they take nothing from or add nothing to its weight and mass centre.
struct GripperBodyParameters : cube::GripperShape {
  double friction{0.8};         ///< of the pads
  double palm_friction{0.3};    ///< of the palm
  double pad_stiffness{8e5};    ///< of a pad, all its points of contact together [N/m]
  double palm_stiffness{8e4};   ///< the same of the palm
  double relaxation{0.002};     ///< damping of the contacts over their stiffness [s]
  double jaw_mass{0.1};         ///< of each jaw with its finger [kg]
  double jaw_force{300};        ///< that a finger bears before it bends, and gives way [N]
  double wrist_stiffness{2e4};  ///< of the wrist between arm and sensor, along x, y and z [N/m]
  double wrist_damping{0.3};    ///< ratio of the wrist with the tool's mass
};

/// @return a gripper of that shape, the rest as usual
[[nodiscard]] inline GripperBodyParameters gripper_body(const cube::GripperShape& shape) {
  GripperBodyParameters p;
  static_cast<cube::GripperShape&>(p) = shape;
  return p;
}

}  // namespace mrroc::sim
