// Converts between the project's types and MuJoCo's arrays; units stay.
#pragma once
#include <Eigen/Geometry>

#include "base/pose.hpp"

namespace mrroc::sim {

inline void set(double (&to)[3], const Vector3& v) { Vector3::Map(to) = v; }

/// @param quat  w, x, y, z
inline void set(double (&pos)[3], double (&quat)[4], const Pose& T) {
  set(pos, T.p);
  const Eigen::Quaterniond q(T.R);
  quat[0] = q.w();
  quat[1] = q.x();
  quat[2] = q.y();
  quat[3] = q.z();
}

/// @param matrix  in rows
[[nodiscard]] inline Pose pose_from(const double* position, const double* matrix) {
  return {Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(matrix), Vector3::Map(position)};
}

}  // namespace mrroc::sim
