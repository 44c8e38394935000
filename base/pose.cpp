#include "base/pose.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace mrroc {

Matrix3 skew(const Vector3& p) {
  Matrix3 S;
  S << 0, -p.z(), p.y(), p.z(), 0, -p.x(), -p.y(), p.x(), 0;
  return S;
}

Matrix3 rotation_from_angle_axis(const Vector3& aa) {
  const double angle2 = aa.squaredNorm();
  const double angle = std::sqrt(angle2);
  const bool small = angle < 1e-4;
  const double a = small ? 1 - angle2 / 6 : std::sin(angle) / angle;
  const double half = small ? 0.5 - angle2 / 48 : std::sin(angle / 2) / angle;
  const double b = 2 * half * half;  // (1 - cos) / angle^2 without cancellation
  const Matrix3 S = skew(aa);
  return Matrix3::Identity() + a * S + b * (S * S);
}

Vector3 angle_axis_from_rotation(const Matrix3& R) {
  Eigen::Quaterniond q(R);
  if (q.w() < 0) q.coeffs() = -q.coeffs();
  const Vector3 v = q.vec();
  const double s = v.norm();  // sin(angle / 2)
  if (s < 1e-8) return 2 * v / q.w();
  if (q.w() < 1e-12) {  // the axis at pi has two signs: choose one
    const Vector3 axis = v / s;
    for (int k = 0; k < 3; ++k)
      if (std::abs(axis[k]) > 1e-9) return (axis[k] > 0 ? 1 : -1) * 2 * std::atan2(s, q.w()) * axis;
  }
  return 2 * std::atan2(s, q.w()) / s * v;
}

Pose pose_from_angle_axis(const AngleAxisPose& r) {
  return {rotation_from_angle_axis(r.tail<3>()), r.head<3>()};
}

AngleAxisPose angle_axis_from_pose(const Pose& T) {
  AngleAxisPose r;
  r << T.p, angle_axis_from_rotation(T.R);
  return r;
}

Matrix3 orthonormal(const Matrix3& R) {
  // One step of the polar iteration: quadratic convergence, and R is already orthonormal to rounding.
  return 0.5 * R * (3 * Matrix3::Identity() - R.transpose() * R);
}

bool is_proper(const Pose& T) {
  return T.R.allFinite() && T.p.allFinite() &&
         (T.R.transpose() * T.R - Matrix3::Identity()).cwiseAbs().maxCoeff() < 1e-6 && T.R.determinant() > 0;
}

}  // namespace mrroc
