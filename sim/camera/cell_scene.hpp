// The simulated cell as cameras see it.
#pragma once
#include <span>
#include <vector>

#include "base/cube/cube_face.hpp"
#include "sim/camera/scene.hpp"
#include "sim/world.hpp"

namespace mrroc::sim {

/// Floor, tables, plates and paper, which never move; and the arms, whose every link is where the world has it, with
/// their grippers, and the cube. Ink is not drawn.
class CellScene {
 public:
  /// Makes what never moves. @param world  as the world was made with
  explicit CellScene(const WorldParameters& world);

  /// @return a picture of the world at this instant: a value that shares nothing which changes
  [[nodiscard]] camera::Scene take(const World& world) const;

 private:
  std::vector<camera::Body> still_;
  std::vector<ArmParameters> arms_;
  CubeFaceShape shape_;
};

}  // namespace mrroc::sim
