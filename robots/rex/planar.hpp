// Plane geometry of the estimators of Rex: the body frame B beside the centre of mass.
#pragma once
#include <Eigen/Core>
#include <cmath>

namespace mrroc::rex {

/// @return the rotation by an angle [rad]
[[nodiscard]] inline Eigen::Matrix2d rotation(double angle) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return (Eigen::Matrix2d() << c, -s, s, c).finished();
}

/// @return a vector turned by 90 degrees: d/dangle rotation(angle) v = rotation(angle) turned(v)
[[nodiscard]] inline Eigen::Vector2d turned(const Eigen::Vector2d& v) noexcept { return {-v.y(), v.x()}; }

}  // namespace mrroc::rex
