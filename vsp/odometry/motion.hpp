// The motion of the platform with its covariance from matches. Only for the sources of this folder.
#pragma once
#include <vector>

#include "vsp/odometry/matching.hpp"

namespace mrroc::vsp {

/// What the matches say.
struct StereoMotion {
  Pose A;  ///< B at the second pair in B at the first
  Matrix6 covariance =
      Matrix6::Zero();  ///< of the error of A: x y z [m], ax ay az [rad] along B at the first pair
  double rms_px{};      ///< root mean square of the inliers' reprojection errors [pixel]
  std::vector<std::size_t> inliers;  ///< numbers of the matches that it rests on
};

/// Least sum of Huber's loss of the reprojection errors in both pictures, from A; then once more from the inliers of that.
/// @param A  e.g. from consensus()
StereoMotion refined(const StereoRig& rig, const std::vector<StereoMatch>& matches, const Pose& A);

}  // namespace mrroc::vsp
