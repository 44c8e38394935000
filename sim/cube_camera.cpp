#include "sim/cube_camera.hpp"

#include <cmath>
#include <numbers>

#include "sim/cube_cell.hpp"

namespace mrroc::sim {

CameraSetup cube_camera() {
  constexpr double kDistance = 0.6;  // [m]
  constexpr double kSlant = 40 * std::numbers::pi / 180;
  const Pose T_UM = meeting_place();
  const Vector3 towards = std::cos(kSlant) * T_UM.R.col(2) - std::sin(kSlant) * T_UM.R.col(0);
  CameraSetup camera;
  camera.key = "cube";
  camera.place = looking_at(T_UM.p + kDistance * towards, shown_place().p, Vector3::UnitZ());
  camera.model.fx = 1100;
  camera.model.fy = 1100;
  return camera;
}

Pose shown_place(const CubeFaceShape& shape) {
  return meeting_place() * Pose{Matrix3::Identity(), {0, 0, shape.edge / 2}};
}

}  // namespace mrroc::sim
