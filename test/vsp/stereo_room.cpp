#include "test/vsp/stereo_room.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

namespace mrroc::test {
namespace {

constexpr double kTile = 2.5;     // edge of what carries one picture [m]
constexpr int kTilePixels = 875;  // along it
constexpr double kLength = 7.5, kWidth = 5, kHeight = 2.5;
constexpr double kBaseline = 0.12;

using Texture = std::shared_ptr<const Image>;

double share(std::mt19937& random) { return std::uniform_real_distribution<>(0, 1)(random); }

/// Adds random values at the corners of squares, interpolated smoothly in between.
void add_value_noise(std::vector<double>& field, int square, double amplitude, std::mt19937& random) {
  const int corners = kTilePixels / square + 2;
  std::vector<double> value(static_cast<std::size_t>(corners * corners));
  for (double& v : value) v = amplitude * (share(random) - 0.5);
  const auto at = [&](int i, int j) { return value[static_cast<std::size_t>(j * corners + i)]; };
  const auto smooth = [](double s) { return s * s * (3 - 2 * s); };
  for (int y = 0; y < kTilePixels; ++y)
    for (int x = 0; x < kTilePixels; ++x) {
      const int i = x / square;
      const int j = y / square;
      const double s = smooth(static_cast<double>(x % square) / square);
      const double t = smooth(static_cast<double>(y % square) / square);
      field[static_cast<std::size_t>(y * kTilePixels + x)] +=
          (1 - t) * ((1 - s) * at(i, j) + s * at(i + 1, j)) +
          t * ((1 - s) * at(i, j + 1) + s * at(i + 1, j + 1));
    }
}

/// Lays round chips of 4 to 35 mm into the field.
void add_chips(std::vector<double>& field, std::mt19937& random) {
  constexpr int kChips = kTilePixels * kTilePixels / 900;
  for (int k = 0; k < kChips; ++k) {
    const double u = kTilePixels * share(random);
    const double v = kTilePixels * share(random);
    const double radius = 1.5 * std::pow(8.0, share(random));
    const double value = share(random) - 0.5;
    for (int y = std::max(0, static_cast<int>(v - radius)); y < std::min<double>(kTilePixels, v + radius);
         ++y)
      for (int x = std::max(0, static_cast<int>(u - radius)); x < std::min<double>(kTilePixels, u + radius);
           ++x)
        if (std::hypot(x - u, y - v) < radius) field[static_cast<std::size_t>(y * kTilePixels + x)] = value;
  }
}

Texture terrazzo(unsigned seed, double contrast) {
  std::mt19937 random(seed);
  std::vector<double> field(static_cast<std::size_t>(kTilePixels * kTilePixels));
  for (const int square : {4, 8, 16, 32, 64}) add_value_noise(field, square, 0.2, random);
  add_chips(field, random);
  auto picture = std::make_shared<Image>(kTilePixels, kTilePixels, 3);
  for (std::size_t k = 0; k < picture->data.size(); ++k)
    picture->data[k] = static_cast<std::uint8_t>(std::clamp(140 + 150 * contrast * field[k / 3], 5.0, 250.0));
  return picture;
}

/// Covers a rectangle with tiles. @param middle  of it @param R  its x and y, and its normal z
void add_surface(camera::Scene& scene, const Vector3& middle, const Matrix3& R, double a, double b,
                 const std::array<Texture, 3>& textures) {
  const int columns = static_cast<int>(std::lround(a / kTile));
  const int rows = static_cast<int>(std::lround(b / kTile));
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      camera::Body tile;
      tile.shape = Shape::quad;
      tile.size = {kTile, kTile, 1};
      tile.T_UB = {
          R, middle + kTile * ((i - 0.5 * (columns - 1)) * R.col(0) + (j - 0.5 * (rows - 1)) * R.col(1))};
      tile.colour = {1, 1, 1};
      tile.shine = 0;
      tile.casts_shadow = false;
      tile.texture = textures[static_cast<std::size_t>(i + j) % textures.size()];
      scene.bodies.push_back(tile);
    }
}

Matrix3 axes(const Vector3& x, const Vector3& y) {
  Matrix3 R;
  R << x, y, x.cross(y);
  return R;
}

void add_furniture(camera::Scene& scene) {
  constexpr int kPieces = 8;
  for (int k = 0; k < kPieces; ++k) {
    camera::Body piece;
    piece.shape = k % 2 == 0 ? Shape::cylinder : Shape::box;
    piece.size = {0.3 + 0.02 * k, 0.4, 0.5 + 0.05 * k};
    piece.T_UB.p = {(kLength / 2 - 0.6) * std::cos(0.8 * k), (kWidth / 2 - 0.5) * std::sin(0.8 * k),
                    piece.size.z() / 2};
    piece.colour = {0.3 + 0.05 * k, 0.6 - 0.03 * k, 0.4};
    scene.bodies.push_back(piece);
  }
}

camera::Scene room(const RoomLook& look) {
  std::array<Texture, 3> textures;
  for (unsigned k = 0; k < textures.size(); ++k) textures[k] = terrazzo(3 * look.seed + k, look.contrast);
  camera::Scene scene;
  const Vector3 x = Vector3::UnitX();
  const Vector3 y = Vector3::UnitY();
  const Vector3 z = Vector3::UnitZ();
  const double h = kHeight / 2;
  add_surface(scene, Vector3::Zero(), Matrix3::Identity(), kLength, kWidth, textures);
  add_surface(scene, {kLength / 2, 0, h}, axes(-y, z), kWidth, kHeight, textures);
  add_surface(scene, {-kLength / 2, 0, h}, axes(y, z), kWidth, kHeight, textures);
  add_surface(scene, {0, kWidth / 2, h}, axes(x, z), kLength, kHeight, textures);
  add_surface(scene, {0, -kWidth / 2, h}, axes(-x, z), kLength, kHeight, textures);
  add_furniture(scene);
  return scene;
}

camera::RenderProfile profile(const RoomLook& look, unsigned camera) {
  camera::RenderProfile p;
  p.samples = 1;
  p.shadow_size = 0;
  p.textures_sharp = false;
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
    : scene_(room(look)),
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
