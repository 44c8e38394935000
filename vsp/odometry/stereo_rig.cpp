#include "vsp/odometry/stereo_rig.hpp"

#include <fmt/core.h>

#include <cmath>
#include <opencv2/calib3d.hpp>
#include <string>

#include "base/fault.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kLeastBaseline = 0.01;  // [m]
constexpr double kMostTurned = 0.3;      // of a camera in S [rad]

[[noreturn]] void refuse(const std::string& text) { throw FaultError(FaultCode::bad_configuration, text); }

Matrix3 rectified_axes(const RigCamera& left, const RigCamera& right) {
  const Vector3 x = (right.T_BC.p - left.T_BC.p).normalized();
  const Vector3 ahead = left.T_BC.R.col(2) + right.T_BC.R.col(2);
  const Vector3 y = ahead.cross(x).normalized();
  Matrix3 R;
  R << x, y, x.cross(y);
  return R;
}

double angle_between(const Matrix3& a, const Matrix3& b) {
  return angle_axis_from_rotation(a.transpose() * b).norm();
}

}  // namespace

StereoRig::StereoRig(const RigCamera& left, const RigCamera& right)
    : left_(left), right_(right), baseline_((right.T_BC.p - left.T_BC.p).norm()) {
  if (!is_proper(left.model) || !is_proper(right.model)) refuse("a camera of the pair has an improper model");
  if (left.model.width != right.model.width || left.model.height != right.model.height)
    refuse(fmt::format("the pictures of a pair must be of one size: left {} x {}, right {} x {}",
                       left.model.width, left.model.height, right.model.width, right.model.height));
  if (!(baseline_ >= kLeastBaseline))
    refuse(fmt::format("the cameras of a pair must be at least {} m apart, they are {:.4f} m", kLeastBaseline,
                       baseline_));
  if ((left.T_BC.R.transpose() * (right.T_BC.p - left.T_BC.p)).x() <= 0)
    refuse("the right camera of the pair is left of the left one");
  T_BS_ = {rectified_axes(left, right), left.T_BC.p};
  for (const RigCamera* camera : {&left, &right})
    if (const double angle = angle_between(T_BS_.R, camera->T_BC.R); !(angle <= kMostTurned))
      refuse(
          fmt::format("the cameras of a pair must look the same way, across the line between them: the {} "
                      "one is turned by {:.2f} rad, {} are allowed",
                      camera == &left ? "left" : "right", angle, kMostTurned));
}

std::vector<Vector2> StereoRig::rectified_left(const std::vector<Vector2>& pixels) const {
  return rectified(left_, pixels);
}

std::vector<Vector2> StereoRig::rectified_right(const std::vector<Vector2>& pixels) const {
  return rectified(right_, pixels);
}

std::vector<Vector2> StereoRig::rectified(const RigCamera& camera, const std::vector<Vector2>& pixels) const {
  std::vector<Vector2> places;
  if (pixels.empty()) return places;
  std::vector<cv::Point2d> seen;
  for (const Vector2& p : pixels) seen.emplace_back(p.x(), p.y());
  const Matrix3 R = T_BS_.R.transpose() * camera.T_BC.R;
  const cv::Matx33d turned(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2));
  std::vector<cv::Point2d> rays;
  cv::undistortPoints(seen, rays, camera_matrix(camera.model), distortion(camera.model), turned,
                      cv::noArray());
  for (const cv::Point2d& r : rays) places.emplace_back(f() * r.x, f() * r.y);
  return places;
}

Vector3 StereoRig::point(const Vector2& left, const Vector2& right) const {
  const double scale = baseline_ / (left.x() - right.x());  // z / f
  return scale * Vector3(left.x(), 0.5 * (left.y() + right.y()), f());
}

}  // namespace mrroc::vsp
