// The body of a two-jaw gripper that can touch things: fingers with pads, a palm, and the elastic wrist it hangs on.
#pragma once
#include "base/spatial.hpp"

namespace mrroc::sim {

/// The gripper's frame is E: midway between the pads, y along their motion, z out of the hand. Masses are part of the
/// tool's: they take nothing from or add nothing to its weight and mass centre.
struct GripperBodyParameters {
  double pad_width{0.05};       ///< along x [m]
  double pad_depth{0.015};      ///< along z [m]
  double pad_thickness{0.01};   ///< along y [m]
  double palm{0.0095};          ///< from E back to the palm, against which a cube's face rests [m]
  double palm_width{0.024};     ///< edge of the square palm [m]
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

}  // namespace mrroc::sim
