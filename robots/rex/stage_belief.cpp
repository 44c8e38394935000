#include "robots/rex/stage_belief.hpp"

#include <cmath>

#include "robots/rex/parameters.hpp"

namespace mrroc::rex {
namespace {

/// @return variances of what is known of a platform at rest
StageVector standing_variances() noexcept {
  constexpr EstimatorPrior kPrior;
  StageVector deviation;
  deviation.segment<3>(kPose).setConstant(kPrior.pose);
  deviation.segment<3>(kVelocity).setConstant(kPrior.velocity);
  deviation.segment<4>(kWheelSpeed).setConstant(kPrior.wheel_speed);
  deviation.segment<3>(kSlipIndex) << kPrior.friction, kPrior.friction, kPrior.split;
  deviation.segment<3>(kCloneIndex).setConstant(kPrior.pose);
  return deviation.cwiseAbs2();
}

}  // namespace

StageBelief standing_belief(const edp::StandingStill& found, const StageWindow& window) noexcept {
  constexpr EstimatorPrior kPrior;
  const PlanarFactor pose = planar_factor({found.p.x, found.p.y, found.p.phi},
                                          Eigen::Map<const Eigen::Matrix3d>(found.covariance.data()),
                                          Eigen::Vector3d::Constant(kPrior.pose));
  StageBelief belief{StageVector::Zero(), standing_variances().asDiagonal()};
  if (pose.valid) {
    const PlanarPose centre = centre_pose(found.p, window.weighed().centre);
    belief.z.segment<3>(kPose) << centre.x, centre.y, centre.phi;
    belief.P.topLeftCorner<3, 3>() = pose.covariance;
  }
  belief.z.segment<3>(kSlipIndex) = friction_of(Slip{});
  belief.z.segment<3>(kCloneIndex) = belief.z.segment<3>(kPose);
  return belief;
}

// One number at a time: errors are independent and of variance 1, so that no matrix is to be inverted.
void correct(StageBelief& belief, const StageResiduals& at, const StageVector& linearised) noexcept {
  const StageVector start = difference(belief.z, linearised);
  StageVector change = StageVector::Zero();
  for (int i = 0; i < at.count; ++i) {
    const StageVector Ph = belief.P * at.H.row(i).transpose();
    const double variance = 1 + at.H.row(i).dot(Ph);
    change -= Ph * ((at.r[i] + at.H.row(i).dot(start + change)) / variance);
    belief.P.noalias() -= Ph * Ph.transpose() / variance;
  }
  belief.z = contained(belief.z + change);
}

void predict(StageBelief& belief, const StageTransition& to, const StageVector& linearised) noexcept {
  constexpr double kRounding = 1e-10;  // keeps P positive
  constexpr double kMost = EstimatorPrior{}.most_slip;
  NoiseVector variance = to.deviation.cwiseAbs2();
  for (int i = kSlipIndex; i < kSlipIndex + 3; ++i)
    if (belief.P(i, i) >= kMost * kMost) variance[i] = 0;
  belief.z = contained(to.z + to.F * difference(belief.z, linearised));
  const StageMatrix FP = to.F * belief.P;
  belief.P.noalias() = FP * to.F.transpose();
  belief.P.diagonal().head<kStageNoises>() += variance;
  belief.P.diagonal().array() += kRounding;
  belief.P = ((belief.P + belief.P.transpose()) / 2).eval();
}

}  // namespace mrroc::rex
