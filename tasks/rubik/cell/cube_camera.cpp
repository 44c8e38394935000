#include "tasks/rubik/cell/cube_camera.hpp"

#include "tasks/rubik/cell/layout.hpp"

namespace mrroc::rubik {

CameraSetup cube_camera() {
  const Viewing viewing = viewing_place();
  CameraSetup camera;
  camera.key = "cube";
  camera.place = viewing.T_UV * Pose{Eigen::DiagonalMatrix<double, 3>(1, -1, -1), {0, 0, viewing.distance}};
  camera.model.fx = 1100;
  camera.model.fy = 1100;
  camera.period = 100;
  return camera;
}

}  // namespace mrroc::rubik
