#include "vsp/odometry/reprojection.hpp"

#include <limits>

namespace mrroc::vsp {
namespace {

constexpr double kNearest = 0.1;  // along the optical axis [m]

}  // namespace

StereoPlace reprojected(const StereoRig& rig, const Pose& A, const Vector3& point, StereoJacobian* J) {
  const Pose T_SB = rig.T_BS().inverse();
  const Matrix3 R = T_SB.R * A.R.transpose();
  const Vector3 arm = point - A.p;
  const Vector3 q = R * arm + T_SB.p;
  if (!(q.z() > kNearest)) return StereoPlace::Constant(std::numeric_limits<double>::infinity());
  const double scale = rig.f() / q.z();
  const double left = scale * q.x();
  const double right = scale * (q.x() - rig.baseline());
  const double row = scale * q.y();
  if (J) {
    Eigen::Matrix<double, 3, 6> dq;
    dq << -R, R * skew(arm);
    J->row(0) = scale * dq.row(0) - left / q.z() * dq.row(2);
    J->row(1) = scale * dq.row(1) - row / q.z() * dq.row(2);
    J->row(2) = scale * dq.row(0) - right / q.z() * dq.row(2);
    J->row(3) = J->row(1);
  }
  return {left, row, right, row};
}

Pose moved(const Pose& A, const Vector6& e) {
  return {orthonormal(rotation_from_angle_axis(e.tail<3>()) * A.R), A.p + e.head<3>()};
}

}  // namespace mrroc::vsp
