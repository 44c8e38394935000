// Scenes, cameras and measurements on pictures for the tests of the renderer.
#pragma once
#include <vector>

#include "base/camera_config.hpp"
#include "base/hash.hpp"
#include "sim/camera/renderer.hpp"
#include "sim/camera/textures.hpp"

namespace mrroc::test {

inline std::uint64_t hash_of(const Image& image) {
  Hash hash;
  hash.add(image.data);
  return hash.value();
}

/// A grey table with its top at z = 0.
inline camera::Body table() {
  camera::Body b;
  b.size = {3, 3, 0.05};
  b.T_UB.p = {0, 0, -0.025};
  b.shine = 0;
  return b;
}

inline camera::Scene board_on_table(const camera::BoardSize& board = {}) {
  camera::Scene scene;
  scene.bodies.push_back(table());
  camera::add_board(scene, board, Pose{Matrix3::Identity(), {0, 0, 0.005}});
  return scene;
}

inline CameraModel bent_camera() {
  CameraModel camera;
  camera.fy = 605;
  camera.cx = 322.3;
  camera.cy = 236.8;
  camera.distortion = {-0.28, 0.09, 0.0008, -0.0006, 0};
  return camera;
}

inline camera::RenderProfile clean(camera::RenderProfile p = camera::exact_profile()) {
  p.noise = 0;
  p.channels = 1;
  return p;
}

/// @return inner corners in G [m]
inline std::vector<Vector3> corners_of(const camera::BoardSize& b) {
  std::vector<Vector3> corners;
  for (int row = 0; row < b.rows; ++row)
    for (int column = 0; column < b.columns; ++column)
      corners.emplace_back((column - (b.columns - 1) / 2.0) * b.square, ((b.rows - 1) / 2.0 - row) * b.square,
                           0);
  return corners;
}

}  // namespace mrroc::test
