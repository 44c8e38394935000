// A flat rubber palm at the end of an arm's tool, which presses on free bodies.
#pragma once
#include "base/pose.hpp"

namespace mrroc::sim {

/// Its face is the xy plane of E, round its origin; z of E points out of it. Its mass is part of the tool's.
struct PalmParameters {
  double width{0.14};        ///< edge of the square [m]
  double thickness{0.02};    ///< behind the face [m]
  double friction{1};        ///< of the rubber; that of a contact is the product with the body's
  double stiffness{1e4};     ///< all points of contact together [N/m]
  double relaxation{0.004};  ///< damping of the contact over its stiffness [s]
};

/// @return middle of the palm's box in E
[[nodiscard]] inline Pose palm_middle(const PalmParameters& p) {
  return {Matrix3::Identity(), {0, 0, -p.thickness / 2}};
}

}  // namespace mrroc::sim
