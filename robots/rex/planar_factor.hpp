// A measured pose or motion in the plane, with its covariance.
#pragma once
#include <Eigen/Core>

namespace mrroc::rex {

/// Three numbers (x, y, phi) that were measured. Trivially copyable.
struct PlanarFactor {
  bool valid{};                ///< there is one; else the rest means nothing
  Eigen::Vector3d value;       ///< [m, m, rad]
  Eigen::Matrix3d covariance;  ///< of value, positive
  Eigen::Matrix3d
      whitening;  ///< W with W covariance W' = 1: makes errors independent and of standard deviation 1
};

/// @param value       [m, m, rad], at most 100 km  @param covariance  of value, symmetric, positive semidefinite
/// @param least       standard deviations that it has at least [m, m, rad], > 0
/// @return the factor; not valid when a number is not finite or too large, or when the covariance is none. Real-time safe
[[nodiscard]] PlanarFactor planar_factor(const Eigen::Vector3d& value, const Eigen::Matrix3d& covariance,
                                         const Eigen::Vector3d& least) noexcept;

}  // namespace mrroc::rex
