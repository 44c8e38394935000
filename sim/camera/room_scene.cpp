#include "sim/camera/room_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "sim/camera/bodies.hpp"

namespace mrroc::sim {
namespace {

using camera::Body;
using camera::Scene;

constexpr double kTile = 2.5;     // longest edge of what carries one picture [m]
constexpr int kTilePixels = 875;  // along it
constexpr std::size_t kTextures = 3;

using Texture = std::shared_ptr<const Image>;
using Textures = std::array<Texture, kTextures>;

/// Between 0 and 1: the same with every library.
double share(std::mt19937& random) { return static_cast<double>(random()) / 4294967296.0; }

/// Brightness of a picture, about 0.
class Field {
 public:
  double& at(int x, int y) { return value_[static_cast<std::size_t>(y * kTilePixels + x)]; }
  [[nodiscard]] const std::vector<double>& values() const { return value_; }

 private:
  std::vector<double> value_ = std::vector<double>(static_cast<std::size_t>(kTilePixels) * kTilePixels);
};

/// Adds random values at the corners of squares, interpolated smoothly in between.
void add_value_noise(Field& field, int square, std::mt19937& random) {
  constexpr double kAmplitude = 0.2;
  const int corners = kTilePixels / square + 2;
  std::vector<double> value(static_cast<std::size_t>(corners * corners));
  for (double& v : value) v = kAmplitude * (share(random) - 0.5);
  const auto corner = [&](int i, int j) { return value[static_cast<std::size_t>(j * corners + i)]; };
  const auto smooth = [](double s) { return s * s * (3 - 2 * s); };
  for (int y = 0; y < kTilePixels; ++y)
    for (int x = 0; x < kTilePixels; ++x) {
      const int i = x / square;
      const int j = y / square;
      const double s = smooth(static_cast<double>(x % square) / square);
      const double t = smooth(static_cast<double>(y % square) / square);
      field.at(x, y) += (1 - t) * ((1 - s) * corner(i, j) + s * corner(i + 1, j)) +
                        t * ((1 - s) * corner(i, j + 1) + s * corner(i + 1, j + 1));
    }
}

/// Lays round chips of 4 to 35 mm into the field.
void add_chips(Field& field, std::mt19937& random) {
  constexpr int kChips = kTilePixels * kTilePixels / 900;
  constexpr double kSmallest = 1.5, kLargest = 12;  // radii [pixel]
  const auto from = [](double place, double radius) {
    return std::max(0, static_cast<int>(std::ceil(place - radius)));
  };
  const auto to = [](double place, double radius) {
    return std::min(kTilePixels - 1, static_cast<int>(std::floor(place + radius)));
  };
  for (int k = 0; k < kChips; ++k) {
    const double u = kTilePixels * share(random);
    const double v = kTilePixels * share(random);
    const double r = kSmallest * std::pow(kLargest / kSmallest, share(random));
    const double value = share(random) - 0.5;
    for (int y = from(v, r); y <= to(v, r); ++y)
      for (int x = from(u, r); x <= to(u, r); ++x)
        if (std::hypot(x - u, y - v) < r) field.at(x, y) = value;
  }
}

Texture terrazzo(std::uint32_t seed, double contrast) {
  constexpr double kGrey = 140, kRange = 150, kDarkest = 5, kBrightest = 250;
  std::mt19937 random(seed);
  Field field;
  for (const int square : {4, 8, 16, 32, 64}) add_value_noise(field, square, random);
  add_chips(field, random);
  auto picture = std::make_shared<Image>(kTilePixels, kTilePixels, 3);
  for (std::size_t k = 0; k < picture->data.size(); ++k)
    picture->data[k] = static_cast<std::uint8_t>(
        std::clamp(kGrey + kRange * contrast * field.values()[k / 3], kDarkest, kBrightest));
  return picture;
}

Textures textures(std::uint32_t seed, double contrast) {
  Textures all;
  for (std::size_t k = 0; k < all.size(); ++k)
    all[k] = terrazzo(static_cast<std::uint32_t>(kTextures * seed + k), contrast);
  return all;
}

/// A rectangle: its middle, with x and y along it and the normal z, and its edges [m].
struct Rectangle {
  Pose T_UR;
  double a{}, b{};
};

/// Covers it with tiles.
void add_surface(Scene& scene, const Rectangle& r, const Textures& textures) {
  const int columns = std::max(1, static_cast<int>(std::ceil(r.a / kTile)));
  const int rows = std::max(1, static_cast<int>(std::ceil(r.b / kTile)));
  const double w = r.a / columns;
  const double h = r.b / rows;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      Body tile =
          body(Shape::quad, {w, h, 1},
               at(r.T_UR, {w * (i - 0.5 * (columns - 1)), h * (j - 0.5 * (rows - 1)), 0}), {1, 1, 1}, 0);
      tile.casts_shadow = false;
      tile.texture = textures[static_cast<std::size_t>(i + j) % textures.size()];
      scene.bodies.push_back(tile);
    }
}

/// A wall that stands on the line between two points, seen from the side on its left.
Rectangle wall(const RoomPoint& from, const RoomPoint& to, double height) {
  const Vector3 a(from[0], from[1], 0);
  const Vector3 b(to[0], to[1], 0);
  const Vector3 x = (b - a).normalized();
  const Vector3 z = Vector3::UnitZ();
  Pose T;
  T.R << x, z, x.cross(z);
  T.p = (a + b) / 2 + z * height / 2;
  // A quad is seen from its z: to the right of the way from a to b.
  T.R.col(0) *= -1;
  T.R.col(2) *= -1;
  return {T, (b - a).norm(), height};
}

/// Its sides; cameras look from below its upper edge.
void add_obstacle(Scene& scene, const Obstacle& obstacle, double height, const Textures& textures) {
  const std::size_t n = obstacle.corner.size();
  for (std::size_t k = 0; k < n; ++k)
    add_surface(scene, wall(obstacle.corner[(k + 1) % n], obstacle.corner[k], height), textures);
}

}  // namespace

Scene room_scene(const Room& room, const RoomLook& look) {
  const Textures floor = textures(look.seed, look.contrast);
  constexpr std::uint32_t kOfWalls = 1U << 24U;  // beyond the seeds of floors
  const Textures walls = textures(look.seed + kOfWalls, look.walls * look.contrast);
  const auto [x0, y0] = room.lower;
  const auto [x1, y1] = room.upper;
  Scene scene;
  add_surface(scene, {Pose{Matrix3::Identity(), {(x0 + x1) / 2, (y0 + y1) / 2, 0}}, x1 - x0, y1 - y0}, floor);
  const std::array<RoomPoint, 4> corner{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}};
  for (std::size_t k = 0; k < corner.size(); ++k)
    add_surface(scene, wall(corner[k], corner[(k + 1) % corner.size()], look.height), walls);
  for (const Obstacle& each : room.obstacles) add_obstacle(scene, each, look.obstacles, walls);
  return scene;
}

}  // namespace mrroc::sim
