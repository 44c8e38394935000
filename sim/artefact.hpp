// The balls by which a cell is calibrated, as they really stand.
#pragma once
#include <vector>

#include "base/spatial.hpp"

namespace mrroc::sim {

/// Balls that stand still. They are as stiff and as smooth as the paper of the arm that touches them (PaperParameters).
struct ArtefactParameters {
  std::vector<Vector3> balls;  ///< their middles in the world [m]
  double diameter{0.06};       ///< of each of them [m], > 0
};

}  // namespace mrroc::sim
