#include "test/vsp/stereo_room.hpp"

#include <cmath>
#include <string>

#include "sim/camera/room_scene.hpp"

namespace mrroc::test {
namespace {

constexpr double kLength = 7.5, kWidth = 5;
constexpr double kBaseline = 0.12;

/// With obstacles along its walls.
Room furnished() {
  constexpr int kPieces = 8;
  Room room{.lower = {-kLength / 2, -kWidth / 2}, .upper = {kLength / 2, kWidth / 2}, .obstacles = {}};
  for (int k = 0; k < kPieces; ++k) {
    const double x = (kLength / 2 - 0.6) * std::cos(0.8 * k);
    const double y = (kWidth / 2 - 0.5) * std::sin(0.8 * k);
    const double a = 0.15 + 0.01 * k;
    const double b = 0.2;
    room.obstacles.push_back(
        {std::to_string(k), {{x - a, y - b}, {x + a, y - b}, {x + a, y + b}, {x - a, y + b}}});
  }
  return room;
}

camera::RenderProfile profile(const RoomLook& look, unsigned camera) {
  camera::RenderProfile p = camera::plain_profile();
  p.channels = 1;
  p.noise = look.noise;
  p.defocus = 0.6;
  p.seed = 2 * look.seed + camera;
  return p;
}

}  // namespace

CameraModel stereo_camera() {
  CameraModel camera;
  camera.fx = camera.fy = 420;
  return camera;
}

Pose stereo_place(double side) {
  constexpr double kDown = 0.25;
  const Vector3 ahead(std::cos(kDown), 0, -std::sin(kDown));
  const Vector3 right = -Vector3::UnitY();
  Matrix3 R;
  R << right, ahead.cross(right), ahead;
  return {R, {0.2, side, 0.45}};
}

vsp::StereoRig stereo_rig() {
  return {{stereo_camera(), stereo_place(kBaseline / 2)}, {stereo_camera(), stereo_place(-kBaseline / 2)}};
}

StereoRoom::StereoRoom(const RoomLook& look)
    : scene_(sim::room_scene(furnished(), {.seed = look.seed, .contrast = look.contrast})),
      left_(stereo_camera(), profile(look, 0)),
      right_(stereo_camera(), profile(look, 1)) {}

PicturePair StereoRoom::pair(const Pose& T_UB, std::int64_t frame) {
  return {left_.render(scene_, T_UB * stereo_place(kBaseline / 2), frame),
          right_.render(scene_, T_UB * stereo_place(-kBaseline / 2), frame)};
}

Pose RandomWay::go_on() {
  constexpr double kWay = 0.08, kTurn = 0.128, kSway = 0.001;
  for (;;) {
    Pose A = planar_motion(uniform(kWay), uniform(kTurn));
    A.p += kSway * Vector3(0, uniform(1), uniform(1));
    A.R *= rotation_from_angle_axis(kSway * Vector3(uniform(1), uniform(1), 0));
    const Pose T_UB = T_UB_ * A;
    const bool tilted = T_UB.R.col(2).z() < 0.9999;
    if (T_UB.p.head<2>().norm() > 1 || std::abs(T_UB.p.z()) > 0.01 || tilted) continue;
    T_UB_ = T_UB;
    return A;
  }
}

Pose planar_motion(double x, double turn) { return {rotation_from_angle_axis({0, 0, turn}), {x, 0, 0}}; }

}  // namespace mrroc::test
