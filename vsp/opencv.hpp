// Converts between the framework's values and OpenCV's; only for the sources of this folder.
#pragma once
#include <opencv2/core.hpp>

#include "base/camera.hpp"
#include "base/image.hpp"

namespace mrroc::vsp {

/// The intrinsics M.
inline cv::Matx33d camera_matrix(const CameraModel& c) { return {c.fx, 0, c.cx, 0, c.fy, c.cy, 0, 0, 1}; }
/// The lens L.
inline cv::Vec<double, 5> distortion(const CameraModel& c) {
  return {c.distortion[0], c.distortion[1], c.distortion[2], c.distortion[3], c.distortion[4]};
}
/// @return whether the picture is one that this camera can have taken: its size, one or three channels
bool fits(const ImageView& picture, const CameraModel& camera);
/// @param picture of one or three channels (blue, green, red)
/// @return brightness, in the picture's own memory when it has only that
cv::Mat grey(const ImageView& picture);
/// @return the picture's own memory, not to be written to
cv::Mat matrix(const ImageView& picture);
/// @param picture  of three channels @return its own memory
inline cv::Mat drawn_on(Image& picture) {
  return {picture.height, picture.width, CV_8UC3, picture.data.data()};
}

}  // namespace mrroc::vsp
