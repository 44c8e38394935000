#include "vsp/odometry/features.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp {
namespace {

constexpr double kQuality = 0.01;  // of the cell's best corner
constexpr double kApart = 8;       // [pixel]

int cell_along(double place, int size, int cells) {
  return std::clamp(static_cast<int>(place * cells / size), 0, cells - 1);
}

}  // namespace

std::vector<Vector2> corners(const cv::Mat& grey) {
  std::vector<Vector2> all;
  std::vector<cv::Point2f> found;
  for (int row = 0; row < kCellRows; ++row)
    for (int column = 0; column < kCellColumns; ++column) {
      const cv::Point first(grey.cols * column / kCellColumns, grey.rows * row / kCellRows);
      const cv::Point end(grey.cols * (column + 1) / kCellColumns, grey.rows * (row + 1) / kCellRows);
      cv::goodFeaturesToTrack(grey(cv::Rect(first, end)), found, kCellFeatures, kQuality, kApart);
      for (const cv::Point2f& p : found) all.emplace_back(double{p.x} + first.x, double{p.y} + first.y);
    }
  return all;
}

int cell_of(const Vector2& place, const cv::Size& size) {
  return cell_along(place.y(), size.height, kCellRows) * kCellColumns +
         cell_along(place.x(), size.width, kCellColumns);
}

}  // namespace mrroc::vsp
