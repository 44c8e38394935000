#include "vsp/cube_face/sticker_colour.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

namespace mrroc::vsp {
namespace {

using Rgb = std::array<double, 3>;

constexpr int kParts = 3;           // along an edge of the inside
constexpr int kSamples = 6;         // along an edge of a part
constexpr double kInside = 0.66;    // of the sticker's edge: blurred borders stay outside
constexpr double kSaturated = 250;  // [grey levels]
constexpr int kLeastParts = 3;      // without glare
// A lamp's image is broader than a sticker: what is mirrored changes less over the sticker than there is of it.
constexpr double kUnseen = 6;
constexpr double kMirroredNoise = 1.5;  // change of it that noise makes [grey levels]

struct Part {
  Rgb rgb{};
  [[nodiscard]] double least() const { return *std::ranges::min_element(rgb); }
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Takes the medians of one part of the sticker. @return share of its pixels that are as bright as can be
double measure(const cv::Mat& colours, const CameraModel& camera, const Pose& T_CG, const Vector3& middle,
               double edge, Part& part) {
  std::array<std::vector<double>, 3> values;
  int saturated = 0;
  for (int i = 0; i < kSamples; ++i)
    for (int j = 0; j < kSamples; ++j) {
      const Vector3 offset((i + 0.5) / kSamples - 0.5, (j + 0.5) / kSamples - 0.5, 0);
      const Vector2 p = project(camera, T_CG * Vector3(middle + edge * offset));
      const int x = static_cast<int>(std::clamp(std::round(p.x()), 0.0, colours.cols - 1.0));
      const int y = static_cast<int>(std::clamp(std::round(p.y()), 0.0, colours.rows - 1.0));
      const auto& bgr = colours.at<cv::Vec3b>(y, x);
      if (std::max({bgr[0], bgr[1], bgr[2]}) >= kSaturated) {
        ++saturated;
        continue;
      }
      for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)].push_back(bgr[2 - c]);
    }
  constexpr double kAll = kSamples * kSamples;
  if (saturated < kAll)
    for (std::size_t c = 0; c < 3; ++c) part.rgb[c] = median(values[c]);
  return saturated / kAll;
}

/// Excess of the light on a part over that on the least bright parts.
struct MoreLight {
  double mirrored{};     // by the gloss, mean over the channels [grey levels]
  double unexplained{};  // largest of a channel [grey levels]
};

/// Explains a part as the same colour with more light on it, as beside a shadow, and some of the lamp's own light, mirrored
/// by the gloss.
MoreLight more_light(const Part& part, const Rgb& rgb) {
  const Eigen::Map<const Vector3> colour(rgb.data());
  const Vector3 more = Eigen::Map<const Vector3>(part.rgb.data()) - colour;
  Eigen::Matrix<double, 3, 2> basis;
  basis << colour, Vector3::Ones();
  basis.col(0) /= colour.maxCoeff() + 1;
  // A little of both is preferred: a white sticker is as grey as the lamp.
  constexpr double kRidge = 0.03;
  const Eigen::Matrix2d normal = basis.transpose() * basis + kRidge * Eigen::Matrix2d::Identity();
  const Eigen::Vector2d share = normal.inverse() * (basis.transpose() * more);
  return {share[1], (more - basis * share).cwiseAbs().maxCoeff()};
}

}  // namespace

StickerReading measure_sticker(const cv::Mat& colours, const CameraModel& camera, const Pose& T_CG,
                               const CubeFaceShape& shape, int sticker, const CubeFaceParameters& k) {
  StickerReading reading;
  std::vector<Part> parts;
  double glaring = 0;
  const double edge = kInside * shape.sticker / kParts;
  for (int i = 0; i < kParts * kParts; ++i) {
    Part part;
    const int column = i % kParts - 1;
    const int row = i / kParts - 1;
    const Vector3 middle = shape.middle(sticker) + edge * Vector3(column, row, 0);
    const double share = measure(colours, camera, T_CG, middle, edge, part);
    glaring += share / (kParts * kParts);
    if (share < 0.5) parts.push_back(part);
  }
  if (parts.size() < kLeastParts || glaring > k.glare_share) {
    reading.flaw = StickerFlaw::glaring;
    return reading;
  }
  std::ranges::sort(parts, {}, &Part::least);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t n = 0; n < kLeastParts; ++n) reading.rgb[c] += parts[n].rgb[c] / kLeastParts;
  constexpr double kTolerance = 4;    // [grey levels]
  constexpr double kRelative = 0.08;  // of the brightness
  constexpr double kTint = 0.3;       // of mirrored light: lamps have colours
  const double tolerance = kTolerance + kRelative * *std::ranges::max_element(reading.rgb);
  double mirrored = 0;
  double unexplained = 0;
  bool same = true;
  for (const Part& part : parts) {
    const MoreLight more = more_light(part, reading.rgb);
    mirrored += more.mirrored * more.mirrored / static_cast<double>(parts.size());
    unexplained += more.unexplained * more.unexplained / static_cast<double>(parts.size());
    same = same && more.mirrored > -tolerance &&
           more.unexplained < tolerance + kTint * std::max(0.0, more.mirrored);
  }
  reading.deviation = kUnseen * std::max(0.0, std::sqrt(mirrored) - kMirroredNoise) + std::sqrt(unexplained);
  if (!same)
    reading.flaw = StickerFlaw::mixed;
  else if (*std::ranges::max_element(reading.rgb) < k.dark)
    reading.flaw = StickerFlaw::dark;
  return reading;
}

}  // namespace mrroc::vsp
