#include "sim/camera/lens.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace mrroc::camera {
namespace {

using Bytes = std::uint8_t __attribute__((vector_size(8)));
using Words = std::uint16_t __attribute__((vector_size(16)));
using HalfWords = std::uint16_t __attribute__((vector_size(8)));
using HalfBytes = std::uint8_t __attribute__((vector_size(4)));

/// @return two neighbouring pixels, a word per channel
Words pair_of_pixels(const std::uint32_t* p) {
  Bytes bytes;
  std::memcpy(&bytes, p, sizeof bytes);
  return __builtin_convertvector(bytes, Words);
}

/// Mean of four pixels, weighted by the distances.
std::uint32_t between(const std::uint32_t* upper, const std::uint32_t* lower, std::uint16_t right,
                      std::uint16_t down) {
  const auto up = static_cast<std::uint16_t>(256 - down);
  const Words column = (pair_of_pixels(upper) * up + pair_of_pixels(lower) * down + 128) >> 8;
  HalfWords left_half;
  HalfWords right_half;
  std::memcpy(&left_half, &column, sizeof left_half);
  std::memcpy(&right_half, reinterpret_cast<const char*>(&column) + sizeof left_half, sizeof right_half);
  const auto left = static_cast<std::uint16_t>(256 - right);
  const HalfWords mean = (left_half * left + right_half * right + 128) >> 8;
  const HalfBytes bytes = __builtin_convertvector(mean, HalfBytes);
  std::uint32_t pixel{};
  std::memcpy(&pixel, &bytes, sizeof pixel);
  return pixel;
}

bool bends(const CameraModel& camera) {
  return std::ranges::any_of(camera.distortion, [](double k) { return k != 0; });
}

}  // namespace

Vector2 unproject(const CameraModel& camera, const Vector2& pixel) {
  constexpr int kMostSteps = 50;
  constexpr double kClose = 1e-9;  // [pixel]
  constexpr double kDelta = 1e-6;
  Vector2 x((pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy);
  const auto seen = [&](double a, double b) { return project(camera, {a, b, 1}); };
  for (int step = 0; step < kMostSteps; ++step) {
    const Vector2 error = seen(x.x(), x.y()) - pixel;
    Eigen::Matrix2d J;
    J.col(0) = (seen(x.x() + kDelta, x.y()) - seen(x.x() - kDelta, x.y())) / (2 * kDelta);
    J.col(1) = (seen(x.x(), x.y() + kDelta) - seen(x.x(), x.y() - kDelta)) / (2 * kDelta);
    // Beyond the fold of the lens the picture turns inside out.
    if (!(J.determinant() > 0.01 * camera.fx * camera.fy)) break;
    if (error.norm() < kClose) return x;
    x -= J.inverse() * error;
  }
  throw std::invalid_argument("camera: the lens bends so much that some pixels see nothing");
}

Lens::Lens(const CameraModel& camera) : pinhole_(camera) {
  if (!bends(camera)) return;
  std::vector<Vector2> points;
  points.reserve(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  Eigen::AlignedBox2d area;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Vector2 x = unproject(camera, {u, v});
      points.emplace_back(camera.fx * x.x(), camera.fy * x.y());
      area.extend(points.back());
    }
  const Vector2 first = (area.min().array() - 1).floor();
  const Eigen::Vector2i size = (area.max() - first).array().ceil().cast<int>() + 2;
  if (static_cast<double>(size.x()) * size.y() > 4.0 * camera.width * camera.height)
    throw std::invalid_argument(
        "camera: the lens bends so much that the picture would have to be four times as large");
  pinhole_.distortion = {};
  pinhole_.width = size.x();
  pinhole_.height = size.y();
  pinhole_.cx = -first.x();
  pinhole_.cy = -first.y();
  sources_.reserve(points.size());
  for (const Vector2& p : points) {
    const Eigen::Array2i place = ((p - first) * 256).array().round().cast<int>();
    const Eigen::Array2i whole = place / 256;
    const Eigen::Array2i rest = place - 256 * whole;
    sources_.push_back({static_cast<std::uint32_t>(whole.y() * size.x() + whole.x()),
                        static_cast<std::uint8_t>(rest.x()), static_cast<std::uint8_t>(rest.y())});
  }
}

void Lens::bend(std::span<const std::uint32_t> seen, std::span<std::uint32_t> bent) const {
  if (sources_.empty()) {
    if (seen.data() != bent.data()) std::ranges::copy(seen, bent.begin());
    return;
  }
  for (std::size_t k = 0; k < sources_.size(); ++k) {
    const Source& s = sources_[k];
    const std::uint32_t* const upper = seen.data() + s.offset;
    bent[k] = between(upper, upper + pinhole_.width, s.right, s.down);
  }
}

}  // namespace mrroc::camera
