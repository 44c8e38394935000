#include "robots/rex/planar_factor.hpp"

#include <Eigen/Cholesky>

namespace mrroc::rex {

PlanarFactor planar_factor(const Eigen::Vector3d& value, const Eigen::Matrix3d& covariance,
                           const Eigen::Vector3d& least) noexcept {
  constexpr double kFar = 1e5;            // [m], [rad]
  constexpr double kMostVariance = 1e10;  // [m^2], [rad^2]
  PlanarFactor factor;
  if (!value.allFinite() || value.cwiseAbs().maxCoeff() > kFar) return factor;
  if (!covariance.allFinite() || covariance.cwiseAbs().maxCoeff() > kMostVariance) return factor;
  if (covariance.diagonal().minCoeff() < 0) return factor;
  factor.value = value;
  factor.covariance = (covariance + covariance.transpose()) / 2;
  factor.covariance.diagonal() = covariance.diagonal().cwiseMax(least.cwiseAbs2());
  const Eigen::LLT<Eigen::Matrix3d> root(factor.covariance);
  factor.whitening = root.matrixL().solve(Eigen::Matrix3d::Identity());
  factor.valid = root.info() == Eigen::Success && factor.whitening.allFinite();
  return factor;
}

}  // namespace mrroc::rex
