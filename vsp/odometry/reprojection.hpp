// Where a pair of cameras sees a point after the platform has moved. Only for the sources of this folder.
#pragma once
#include <Eigen/Core>

#include "vsp/odometry/matching.hpp"

namespace mrroc::vsp {

/// Derivative of a place by the motion's error: x y z [m], then ax ay az [rad], both along B of the first pair.
using StereoJacobian = Eigen::Matrix<double, 4, 6>;

/// @param A      motion of the platform: B at the second pair in B at the first
/// @param point  in B at the first pair [m]
/// @param J      if not null, the derivative
/// @return where the point is seen in the second pair [pixel]; infinite when it is less than 10 cm in front of the cameras
StereoPlace reprojected(const StereoRig& rig, const Pose& A, const Vector3& point,
                        StereoJacobian* J = nullptr);

/// @return A with the error e put right: p + e_xyz, R turned by e_a
Pose moved(const Pose& A, const Vector6& e);

}  // namespace mrroc::vsp
