// Rectified images: pictures without the lens's distortion. Only for the sources of this folder.
#pragma once
#include <opencv2/core.hpp>

#include "base/camera.hpp"

namespace mrroc::vsp {

/// Maps the pictures of one camera to those of a camera without distortion that sees at least as much.
class RectifiedImage {
 public:
  /// @param camera  with distortion; its maps are made here
  explicit RectifiedImage(const CameraModel& camera);

  /// @return the camera that would take the rectified pictures: same focal lengths, larger when the lens is a wide one
  [[nodiscard]] const CameraModel& camera() const { return rectified_; }
  /// @param part  of the rectified picture, inside of it
  /// @return that part; black where the camera does not look
  [[nodiscard]] cv::Mat part(const cv::Mat& grey, const cv::Rect& part) const;
  /// @return the rectified picture as a part of itself
  [[nodiscard]] cv::Rect whole() const { return {0, 0, rectified_.width, rectified_.height}; }

 private:
  CameraModel rectified_;
  cv::Mat map_;
  cv::Mat fraction_;
};

}  // namespace mrroc::vsp
