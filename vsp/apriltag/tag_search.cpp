#include "vsp/apriltag/tag_search.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace mrroc::vsp {
namespace {

constexpr double kRegionMargin = 0.5;  // around the tag, in its own sizes
constexpr double kLeastMargin = 24;    // [pixel]
constexpr int kMostEdges = 10;         // one in so many pixels

}  // namespace

cv::Rect part_around(const Corners& corners, const cv::Rect& whole) {
  const auto low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2].cwiseMin(corners[3])).eval();
  const auto high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2].cwiseMax(corners[3])).eval();
  const double reach = std::max(kLeastMargin, kRegionMargin * (high - low).maxCoeff());
  const cv::Point2d first(low.x() - reach, low.y() - reach);
  const cv::Point2d last(high.x() + reach, high.y() + reach);
  return cv::Rect(cv::Rect2d(first, last)) & whole;
}

bool is_cluttered(const cv::Mat& grey, double blur, int contrast) {
  cv::Mat smooth;
  cv::GaussianBlur(grey, smooth, {0, 0}, blur);
  cv::Mat step;
  cv::absdiff(smooth.colRange(2, smooth.cols), smooth.colRange(0, smooth.cols - 2), step);
  return static_cast<std::size_t>(cv::countNonZero(step > contrast)) * kMostEdges > step.total();
}

}  // namespace mrroc::vsp
