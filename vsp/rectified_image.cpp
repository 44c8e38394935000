#include "vsp/rectified_image.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kMostGrowth = 0.4;  // of the picture's edges to either side

// The frame of the picture, where it is without distortion [pixel].
cv::Rect2d rectified_frame(const CameraModel& camera) {
  std::vector<cv::Point2d> border;
  constexpr int kSteps = 20;
  for (int k = 0; k <= kSteps; ++k) {
    const double u = static_cast<double>(k) / kSteps * (camera.width - 1);
    const double v = static_cast<double>(k) / kSteps * (camera.height - 1);
    border.insert(border.end(), {{u, 0}, {u, camera.height - 1.0}, {0, v}, {camera.width - 1.0, v}});
  }
  std::vector<cv::Point2d> rectified;
  cv::undistortPoints(border, rectified, camera_matrix(camera), distortion(camera), cv::noArray(),
                      camera_matrix(camera));
  cv::Point2d low(0, 0);
  cv::Point2d high(camera.width - 1, camera.height - 1);
  for (const cv::Point2d& p : rectified) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  low = {std::max(low.x, -kMostGrowth * camera.width), std::max(low.y, -kMostGrowth * camera.height)};
  high = {std::min(high.x, (1 + kMostGrowth) * camera.width),
          std::min(high.y, (1 + kMostGrowth) * camera.height)};
  return {low, high};
}

}  // namespace

RectifiedImage::RectifiedImage(const CameraModel& camera) : rectified_(camera) {
  const cv::Rect2d frame = rectified_frame(camera);
  const double left = std::floor(frame.x);
  const double up = std::floor(frame.y);
  rectified_.width = static_cast<int>(std::ceil(frame.x + frame.width) - left) + 1;
  rectified_.height = static_cast<int>(std::ceil(frame.y + frame.height) - up) + 1;
  rectified_.cx -= left;
  rectified_.cy -= up;
  rectified_.distortion = {};
  cv::initUndistortRectifyMap(camera_matrix(camera), distortion(camera), cv::noArray(),
                              camera_matrix(rectified_), {rectified_.width, rectified_.height}, CV_16SC2,
                              map_, fraction_);
}

cv::Mat RectifiedImage::part(const cv::Mat& grey, const cv::Rect& part) const {
  cv::Mat result;
  cv::remap(grey, result, map_(part), fraction_(part), cv::INTER_LINEAR, cv::BORDER_CONSTANT);
  return result;
}

}  // namespace mrroc::vsp
