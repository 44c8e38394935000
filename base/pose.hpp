// Homogeneous matrices, the operator A_A and the re-expression of velocities and forces.
// Zielinski & Winiarski, "Motion Generation in the MRROC++ Robot Programming Framework" (MG), sec. 6.
#pragma once
#include <Eigen/Geometry>

#include "base/spatial.hpp"

namespace mrroc {

/// Pose of a frame Q in a frame U, the papers' homogeneous matrix U_Q T = [R P; 0 1]. Named T_UQ in code, so
/// that adjacent letters match: T_0E = T_0W * T_WE. Every function is real-time safe.
struct Pose {
  Matrix3 R = Matrix3::Identity();  ///< orientation of Q in U, a rotation matrix
  Vector3 p = Vector3::Zero();      ///< origin of Q in U [m]

  /// @return T_UQ * T_QS = T_US
  friend Pose operator*(const Pose& a, const Pose& b) { return {a.R * b.R, a.R * b.p + a.p}; }
  /// @return the point given in Q, in U [m]
  friend Vector3 operator*(const Pose& a, const Vector3& point) { return a.R * point + a.p; }
  /// @return T_QU
  [[nodiscard]] Pose inverse() const { return {R.transpose(), -(R.transpose() * p)}; }
};

/// Position [m] and orientation as angle times unit axis [rad]: the papers' r_(A). Also a displacement.
using AngleAxisPose = Vector6;

/// @return the skew-symmetric matrix S(p), S(p) a = p x a
Matrix3 skew(const Vector3& p);

/// Rotation by |aa| about aa. Uses the series near zero, so that the slowest rotation is not lost.
/// @param aa angle times axis [rad], any length
Matrix3 rotation_from_angle_axis(const Vector3& aa);

/// Inverse of rotation_from_angle_axis, angle in [0, pi]. At pi the axis is the one whose first non-zero
/// component is positive.
/// @param R rotation matrix
Vector3 angle_axis_from_rotation(const Matrix3& R);

/// The operator A_A: r_(A) -> homogeneous matrix (MG, sec. 6).
Pose pose_from_angle_axis(const AngleAxisPose& r);

/// The operator A_A^-1: homogeneous matrix -> r_(A).
AngleAxisPose angle_axis_from_pose(const Pose& T);

/// Rotates R a little so that it is orthonormal again; removes the rounding of many multiplications.
/// @param R nearly a rotation matrix
Matrix3 orthonormal(const Matrix3& R);

/// xi_* (MG 19): a free six-vector in the orientation of U.
/// @param R_UQ orientation of Q in U
template <class Tag>
Spatial<Tag> xi_star(const Matrix3& R_UQ, const Spatial<Tag>& in_Q) {
  return Spatial<Tag>::from(R_UQ * in_Q.linear(), R_UQ * in_Q.angular());
}

/// U_Q xi_V (MG 24): velocity of the rigidly bound frame U, in U.
/// @param v_Q velocity of frame Q expressed in Q
inline Twist xi_V(const Pose& T_UQ, const Twist& v_Q) {
  const Vector3 w = T_UQ.R * v_Q.angular();
  return Twist::from(T_UQ.R * v_Q.linear() + T_UQ.p.cross(w), w);
}

/// U_Q xi_F (MG 25): the force acting at Q, reduced to the origin of U and expressed in U.
/// @param F_Q force acting at the origin of Q expressed in Q
inline Wrench xi_F(const Pose& T_UQ, const Wrench& F_Q) {
  const Vector3 f = T_UQ.R * F_Q.linear();
  return Wrench::from(f, T_UQ.p.cross(f) + T_UQ.R * F_Q.angular());
}

/// @return whether every element is finite and R is a rotation matrix to within 1e-6
bool is_proper(const Pose& T);

}  // namespace mrroc
