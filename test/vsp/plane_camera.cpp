#include "test/vsp/plane_camera.hpp"

#include <apriltag/apriltag.h>
#include <apriltag/tag36h11.h>

#include <memory>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>

namespace mrroc::test {
namespace {

constexpr float kLight = 235;
constexpr float kDark = 18;

// A part of one field of noise, chosen by the seed: making a new one takes longer than a detection.
cv::Mat unit_noise(cv::Size size, unsigned seed) {
  constexpr int kRoom = 512;
  static const cv::Mat field = [] {
    cv::Mat all(1024 + kRoom, 1280 + kRoom, CV_32F);
    cv::RNG(7).fill(all, cv::RNG::NORMAL, 0, 1);
    return all;
  }();
  const unsigned mixed = seed * 2654435761U;
  const cv::Point at(static_cast<int>((mixed >> 8U) % kRoom), static_cast<int>((mixed >> 20U) % kRoom));
  return field({at, size});
}

}  // namespace

PlaneCamera::PlaneCamera(const CameraModel& camera, int samples) : camera_(camera), samples_(samples) {
  std::vector<cv::Point2d> seen;
  for (int v = 0; v < camera.height * samples; ++v)
    for (int u = 0; u < camera.width * samples; ++u)
      seen.emplace_back((u + 0.5) / samples - 0.5, (v + 0.5) / samples - 0.5);
  const auto& d = camera.distortion;
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(seen, rays, cv::Matx33d(camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1),
                      cv::Vec<double, 5>(d[0], d[1], d[2], d[3], d[4]), cv::noArray(), cv::noArray(),
                      cv::TermCriteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 40, 1e-9));
  for (const cv::Point2d& r : rays) rays_.emplace_back(static_cast<float>(r.x), static_cast<float>(r.y));
}

Image PlaneCamera::render(const Pose& T_CG, const Texture& texture, const Exposure& exposure) const {
  const Pose T_GC = T_CG.inverse();
  cv::Mat sum(camera_.height, camera_.width, CV_32F, cv::Scalar(0));
  auto ray = rays_.begin();
  for (int v = 0; v < camera_.height * samples_; ++v) {
    auto* row = sum.ptr<float>(v / samples_);
    for (int u = 0; u < camera_.width * samples_; ++u, ++ray) {
      const Vector3 direction = T_GC.R * Vector3(ray->x(), ray->y(), 1);
      const double way = -T_GC.p.z() / direction.z();
      if (!(way > 0)) continue;
      row[u / samples_] += texture(T_GC.p.x() + way * direction.x(), T_GC.p.y() + way * direction.y());
    }
  }
  sum *= 1.0 / (samples_ * samples_);
  return exposed(sum, exposure);
}

Image exposed(cv::Mat sum, const Exposure& exposure) {
  sum = sum * exposure.gain + exposure.offset;
  if (exposure.blur > 0) cv::GaussianBlur(sum, sum, {0, 0}, exposure.blur);
  if (exposure.noise > 0) sum += exposure.noise * unit_noise(sum.size(), exposure.seed);
  Image picture(sum.cols, sum.rows, 1);
  cv::Mat bytes(sum.rows, sum.cols, CV_8U, picture.data.data());
  sum.convertTo(bytes, CV_8U);
  return picture;
}

PlaneCamera::Texture chessboard_texture(int columns, int rows, double square, double margin, float table) {
  const double half_width = 0.5 * (columns + 1) * square;
  const double half_height = 0.5 * (rows + 1) * square;
  return [=](double x, double y) {
    if (std::abs(x) > half_width + margin || std::abs(y) > half_height + margin) return table;
    if (std::abs(x) >= half_width || std::abs(y) >= half_height) return kLight;
    const int column = static_cast<int>((x + half_width) / square);
    const int row = static_cast<int>((half_height - y) / square);
    return (row + column) % 2 == 0 ? kDark : kLight;
  };
}

PlaneCamera::Texture tag_texture(int id, double edge, double margin, float table) {
  apriltag_family_t* const family = tag36h11_create();
  image_u8_t* const image = apriltag_to_image(family, static_cast<unsigned>(id));
  const int cells = image->width;  // 8 of the border and code, one light one around them
  auto dark = std::make_shared<std::vector<bool>>();
  for (int v = 0; v < cells; ++v)
    for (int u = 0; u < cells; ++u) dark->push_back(image->buf[v * image->stride + u] < 128);
  image_u8_destroy(image);
  tag36h11_destroy(family);
  const double cell = edge / (cells - 2);
  const double half = 0.5 * cells * cell;
  return [=](double x, double y) {
    if (std::max(std::abs(x), std::abs(y)) > 0.5 * edge + margin) return table;
    if (std::max(std::abs(x), std::abs(y)) >= half) return kLight;
    const int u = static_cast<int>((x + half) / cell);
    const int v = static_cast<int>((half - y) / cell);
    return (*dark)[static_cast<std::size_t>(v * cells + u)] ? kDark : kLight;
  };
}

Pose facing(double distance, double tilt, double azimuth, double roll, double x, double y) {
  const auto about = [](double angle, int axis) {
    Vector3 a = Vector3::Zero();
    a[axis] = angle;
    return rotation_from_angle_axis(a);
  };
  return {
      about(azimuth, 2) * about(tilt, 0) * about(-azimuth, 2) * about(std::numbers::pi, 0) * about(roll, 2),
      {x, y, distance}};
}

}  // namespace mrroc::test
