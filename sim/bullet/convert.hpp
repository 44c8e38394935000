// Converts between the project's types and Bullet's.
#pragma once
#include <LinearMath/btTransform.h>

#include "base/pose.hpp"

namespace mrroc::sim {

/// Vectors, rotations and poses as Bullet has them, and back; units stay.
inline btVector3 to_bullet(const Vector3& v) { return {v.x(), v.y(), v.z()}; }
inline Vector3 from_bullet(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

inline btMatrix3x3 to_bullet(const Matrix3& R) {
  return {R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)};
}

/// @return the rotation as a quaternion
inline btQuaternion quaternion(const Matrix3& R) {
  btQuaternion q;
  to_bullet(R).getRotation(q);
  return q;
}

inline btTransform to_bullet(const Pose& T) { return btTransform(to_bullet(T.R), to_bullet(T.p)); }

inline Pose from_bullet(const btTransform& T) {
  Pose out;
  for (int row = 0; row < 3; ++row) out.R.row(row) = from_bullet(T.getBasis().getRow(row)).transpose();
  out.p = from_bullet(T.getOrigin());
  return out;
}

}  // namespace mrroc::sim
