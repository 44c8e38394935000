#include "sim/cube_camera.hpp"

#include "sim/cube_cell.hpp"

namespace mrroc::sim {

CameraSetup cube_camera() {
  const rubik::Viewing viewing = viewing_place();
  CameraSetup camera;
  camera.key = "cube";
  camera.place = viewing.T_UV * Pose{Eigen::DiagonalMatrix<double, 3>(1, -1, -1), {0, 0, viewing.distance}};
  camera.model.fx = 1100;
  camera.model.fy = 1100;
  camera.period = 100;
  return camera;
}

}  // namespace mrroc::sim
