// Matches of features between two pairs of pictures. Only for the sources of this folder.
#pragma once
#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

#include "vsp/odometry/stereo_rig.hpp"

namespace mrroc::vsp {

/// A picture in several sizes, prepared for the optical flow.
using Pyramid = std::vector<cv::Mat>;
/// @param grey  one channel of bytes
Pyramid pyramid_of(const cv::Mat& grey);

/// One pair of pictures, taken at the same time.
struct StereoPair {
  Pyramid left, right;
};

/// Rectified places of a point in a pair (stereo_rig.hpp): column and row in the left picture, in the right one [pixel].
using StereoPlace = Eigen::Vector4d;

/// A point that stands still in the room, seen in both pairs.
struct StereoMatch {
  Vector3 point;     ///< where it was on the platform when the first pair was taken [m]
  StereoPlace seen;  ///< in the second pair
  Vector2 pixel;     ///< in the left picture of the first pair
  Vector2 now;       ///< in that of the second
};

/// What was found of a picture's features.
struct StereoMatches {
  std::vector<StereoMatch> points;  ///< of the room
  int crossed{};  ///< features further left in the left pictures than in the right ones: none of a room
};

/// Follows features by optical flow (Lucas and Kanade, 1981) round a circle: from the left picture of the first pair into
/// its right one, and to the second pair, left, then right, then back in time. It must close within 0.7 pixel. In both pairs
/// the point must have a disparity of at least one pixel, and rows that differ by at most one. Equal pictures give equal
/// bits, with any number of OpenCV's threads.
/// @param features  in the left picture of the first pair [pixel]
StereoMatches stereo_matches(const StereoRig& rig, const StereoPair& before, const StereoPair& now,
                             const std::vector<Vector2>& features);

}  // namespace mrroc::vsp
