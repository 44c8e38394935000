// Poses in messages: the upper three rows of the homogeneous matrix, [R P] row by row.
#pragma once
#include "base/pose.hpp"

namespace mrroc {

/// @param rows  of the message: R without unit, P [m]
inline void put_rows(double (&rows)[12], const Pose& T) {
  Eigen::Map<Eigen::Matrix<double, 3, 4, Eigen::RowMajor>>(rows) << T.R, T.p;
}

/// @param rows  as above; whether R is a rotation is not looked at
[[nodiscard]] inline Pose pose_from_rows(const double (&rows)[12]) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> m(rows);
  return {m.leftCols<3>(), m.col(3)};
}

}  // namespace mrroc
