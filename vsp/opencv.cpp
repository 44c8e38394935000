#include "vsp/opencv.hpp"

#include <opencv2/imgproc.hpp>

namespace mrroc::vsp {

bool fits(const ImageView& picture, const CameraModel& camera) {
  return picture.data != nullptr && picture.width == camera.width && picture.height == camera.height &&
         (picture.channels == 1 || picture.channels == 3);
}

cv::Mat matrix(const ImageView& picture) {
  // OpenCV has no matrices of constants.
  auto* const data =
      const_cast<std::uint8_t*>(picture.data);  // NOLINT(cppcoreguidelines-pro-type-const-cast)
  return {picture.height, picture.width, CV_8UC(picture.channels), data};
}

cv::Mat grey(const ImageView& picture) {
  cv::Mat all = matrix(picture);
  if (picture.channels == 1) return all;
  cv::Mat brightness;
  cv::cvtColor(all, brightness, cv::COLOR_BGR2GRAY);
  return brightness;
}

}  // namespace mrroc::vsp
