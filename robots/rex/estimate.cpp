#include "robots/rex/estimate.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace mrroc::rex {
namespace {

double deviation(const StageBelief& belief, int index) noexcept {
  return std::sqrt(std::max(belief.P(index, index), 0.0));
}

}  // namespace

edp::EstimatorResult result_of(const StageBelief& belief, const StageWindow& window,
                               const edp::Health& health) noexcept {
  const State x = belief.z.head<10>();
  const WindowStage& newest = window.newest();
  const PlanarPose& centre = window.weighed().centre;
  edp::EstimatorResult result;
  result.estimate.step = newest.step;
  result.estimate.p = pose_of(x, centre);
  result.estimate.p.phi = wrap_angle(result.estimate.p.phi);
  result.estimate.v = velocity_of(x, centre);
  Eigen::Vector4d::Map(result.estimate.theta.data()) = newest.theta;
  Eigen::Vector4d::Map(result.estimate.theta_dot.data()) = x.segment<4>(kWheelSpeed);
  Eigen::Matrix3d::Map(result.estimate.covariance.data()) = pose_covariance(belief, window.centre());
  result.slip = {belief.z[kSlipIndex], belief.z[kSlipIndex + 1], belief.z[kSlipIndex + 2]};
  result.slip_sd = {deviation(belief, kSlipIndex), deviation(belief, kSlipIndex + 1),
                    deviation(belief, kSlipIndex + 2)};
  result.mass = window.weighed().mass;
  result.centre = centre;
  result.health = health;
  return result;
}

edp::EstimatorResult no_result() noexcept {
  edp::EstimatorResult result;
  result.health.ok = false;
  return result;
}

Eigen::Matrix3d pose_covariance(const StageBelief& belief, const Eigen::Vector2d& centre) noexcept {
  const auto slope = pose_of_body(belief.z, centre, 0).slope;
  const Eigen::Matrix3d covariance = slope * belief.P * slope.transpose();
  return (covariance + covariance.transpose()) / 2;
}

bool beyond_ellipse(const WindowStage& stage, const StageVector& z, const Eigen::Matrix3d& covariance,
                    const Eigen::Vector2d& centre, double times) noexcept {
  constexpr double kChiSquare = 16.27;  // 99.9 % of three numbers
  Eigen::Vector3d error = pose_of_body(z, centre, stage.map_delay).value - stage.map.value;
  error[2] = wrap_angle(error[2]);
  const Eigen::Matrix3d expected = covariance + stage.map.covariance;
  return error.dot(expected.ldlt().solve(error)) > times * times * kChiSquare;
}

}  // namespace mrroc::rex
