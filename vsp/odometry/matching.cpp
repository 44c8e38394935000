#include "vsp/odometry/matching.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <opencv2/video/tracking.hpp>

namespace mrroc::vsp {
namespace {

constexpr int kLevels = 4;                // besides the picture itself
constexpr double kClosed = 0.7;           // how far from its beginning a circle may end [pixel]
constexpr double kLeastDisparity = 1;     // [pixel]
constexpr double kMostRowDifference = 1;  // [pixel]
const cv::Size kWindow(13, 13);           // what is compared [pixel]

using Pixels = std::vector<cv::Point2f>;
using Found = std::vector<std::uint8_t>;

/// Places of features in four pictures [pixel]: feature by feature.
struct Circles {
  std::vector<Vector2> left_before, right_before, left, right;
};

/// @param guess  where they may be in `to`
/// @return where they are
Pixels follow(const Pyramid& from, const Pyramid& to, const Pixels& places, Pixels guess, Found& found) {
  constexpr int kSteps = 10;
  constexpr double kSettled = 0.01;  // [pixel]
  cv::calcOpticalFlowPyrLK(from, to, places, guess, found, cv::noArray(), kWindow, kLevels,
                           {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, kSteps, kSettled},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  return guess;
}

Pixels sum(Pixels a, const Pixels& b, const Pixels& minus) {
  for (std::size_t k = 0; k < a.size(); ++k) a[k] += b[k] - minus[k];
  return a;
}

bool inside(const cv::Point2f& p, const cv::Mat& picture) {
  return p.x >= 0 && p.y >= 0 && p.x <= static_cast<float>(picture.cols - 1) &&
         p.y <= static_cast<float>(picture.rows - 1);
}

Circles closed_circles(const StereoPair& before, const StereoPair& now,
                       const std::vector<Vector2>& features) {
  Circles all;
  if (features.empty()) return all;
  Pixels left_before;
  for (const Vector2& p : features)
    left_before.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  std::array<Found, 4> found;
  const Pixels right_before = follow(before.left, before.right, left_before, left_before, found[0]);
  const Pixels left = follow(before.left, now.left, left_before, left_before, found[1]);
  const Pixels right = follow(now.left, now.right, left, sum(left, right_before, left_before), found[2]);
  const Pixels back = follow(now.right, before.right, right, sum(right, left_before, left), found[3]);
  const auto vector = [](const cv::Point2f& p) { return Vector2(p.x, p.y); };
  for (std::size_t k = 0; k < features.size(); ++k) {
    if (std::ranges::any_of(found, [&](const Found& one) { return one[k] == 0; })) continue;
    const cv::Mat& picture = now.left.front();
    if (!inside(right_before[k], picture) || !inside(left[k], picture) || !inside(right[k], picture))
      continue;
    if (!(cv::norm(back[k] - right_before[k]) <= kClosed)) continue;
    all.left_before.push_back(features[k]);
    all.right_before.push_back(vector(right_before[k]));
    all.left.push_back(vector(left[k]));
    all.right.push_back(vector(right[k]));
  }
  return all;
}

/// @return how much further right a place is in the left picture [pixel]; 0: the two are not one point
double disparity(const Vector2& left, const Vector2& right) {
  return std::abs(left.y() - right.y()) <= kMostRowDifference ? left.x() - right.x() : 0;
}

}  // namespace

Pyramid pyramid_of(const cv::Mat& grey) {
  Pyramid pyramid;
  cv::buildOpticalFlowPyramid(grey, pyramid, kWindow, kLevels);
  return pyramid;
}

StereoMatches stereo_matches(const StereoRig& rig, const StereoPair& before, const StereoPair& now,
                             const std::vector<Vector2>& features) {
  const Circles circles = closed_circles(before, now, features);
  const std::vector<Vector2> left_before = rig.rectified_left(circles.left_before);
  const std::vector<Vector2> right_before = rig.rectified_right(circles.right_before);
  const std::vector<Vector2> left = rig.rectified_left(circles.left);
  const std::vector<Vector2> right = rig.rectified_right(circles.right);
  StereoMatches matches;
  for (std::size_t k = 0; k < left.size(); ++k) {
    const double before_px = disparity(left_before[k], right_before[k]);
    const double now_px = disparity(left[k], right[k]);
    if (before_px <= -kLeastDisparity && now_px <= -kLeastDisparity) ++matches.crossed;
    const bool of_the_room = before_px >= kLeastDisparity && now_px >= kLeastDisparity;  // no number is not
    if (!of_the_room) continue;
    StereoMatch match;
    match.point = rig.T_BS() * rig.point(left_before[k], right_before[k]);
    match.seen << left[k], right[k];
    match.pixel = circles.left_before[k];
    match.now = circles.left[k];
    matches.points.push_back(match);
  }
  return matches;
}

}  // namespace mrroc::vsp
