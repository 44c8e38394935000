#include "test/vsp/stereo_room.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

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
  p.defocus = look.defocus;
  p.seed = 2 * look.seed + camera;
  return p;
}

/// The camera as it really is.
CameraModel true_camera(const RoomLook& look) {
  CameraModel camera = stereo_camera();
  camera.fx *= look.lens;
  camera.fy *= look.lens;
  return camera;
}

/// Squares of 10 cm on tiles of 2.5 m.
std::shared_ptr<const Image> squares() {
  constexpr int kSquares = 25, kPixels = 16;
  auto picture = std::make_shared<Image>(kSquares * kPixels, kSquares * kPixels, 3);
  for (int y = 0; y < picture->height; ++y)
    for (int x = 0; x < picture->width; ++x) {
      const bool light = (x / kPixels + y / kPixels) % 2 == 0;
      std::fill_n(picture->row(y) + std::ptrdiff_t{3} * x, 3, static_cast<std::uint8_t>(light ? 190 : 70));
    }
  return picture;
}

camera::Scene scene_of(const RoomLook& look) {
  camera::Scene scene =
      sim::room_scene(furnished(), {.seed = look.seed, .contrast = look.contrast, .walls = look.walls});
  scene.light.exposure = look.exposure;
  if (!look.pattern) return scene;
  const auto picture = squares();
  for (camera::Body& body : scene.bodies)
    if (body.texture) body.texture = picture;
  return scene;
}

/// White rings that stand still in the picture: edges which are of no room.
void add_glare(Image& picture) {
  const double x0 = 0.55 * picture.width, y0 = 0.4 * picture.height;
  constexpr double kRadius = 110, kRing = 12;  // [pixel]
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) {
      const double r = std::hypot(x - x0, y - y0);
      const double angle = std::atan2(y - y0, x - x0);
      const bool white = r < kRadius && (std::fmod(r, 2 * kRing) < kRing || std::sin(8 * angle) > 0.5);
      if (white)
        std::fill_n(picture.row(y) + std::ptrdiff_t{picture.channels} * x, picture.channels,
                    std::uint8_t{255});
    }
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
    : look_(look),
      scene_(scene_of(look)),
      left_(true_camera(look), profile(look, 0)),
      right_(true_camera(look), profile(look, 1)) {}

PicturePair StereoRoom::pair(const Pose& T_UB, std::int64_t frame, const SteadyMotion& motion) {
  const Pose turned{rotation_from_angle_axis(look_.turned), Vector3::Zero()};
  return {picture(left_, T_UB, stereo_place(kBaseline / 2), frame, motion),
          picture(right_, T_UB, stereo_place(-kBaseline / 2) * turned, frame, motion)};
}

Image StereoRoom::picture(camera::Renderer& camera, const Pose& T_UB, const Pose& T_BC, std::int64_t frame,
                          const SteadyMotion& motion) const {
  const int instants = look_.blur > 0 ? 5 : 1;
  std::vector<camera::Instant> exposure;
  for (int k = 0; k < instants; ++k) {
    const double share = instants > 1 ? look_.blur * (k / (instants - 1.0) - 0.5) : 0;
    exposure.push_back({scene_, T_UB * planar_motion(share * motion.x, share * motion.turn) * T_BC});
  }
  Image picture = camera.render(exposure, frame);
  if (look_.glare) add_glare(picture);
  return picture;
}

Pose RandomWay::go_on() {
  constexpr double kWay = 0.08, kTurn = 0.128, kSway = 0.001, kMostChange = 0.07;
  for (;;) {
    Pose A = planar_motion(uniform(kWay), uniform(kTurn));
    A.p += kSway * Vector3(0, uniform(1), uniform(1));
    A.R *= rotation_from_angle_axis(kSway * Vector3(uniform(1), uniform(1), 0));
    const Pose T_UB = T_UB_ * A;
    const bool tilted = T_UB.R.col(2).z() < 0.9999;
    if (T_UB.p.head<2>().norm() > 1 || std::abs(T_UB.p.z()) > 0.01 || tilted) continue;
    if ((A.p - last_).norm() > kMostChange) continue;
    T_UB_ = T_UB;
    last_ = A.p;
    return A;
  }
}

Pose planar_motion(double x, double turn) { return {rotation_from_angle_axis({0, 0, turn}), {x, 0, 0}}; }

}  // namespace mrroc::test
