#include "sim/elastic_gears.hpp"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <numbers>
#include <stdexcept>

#include "base/fault.hpp"

namespace mrroc::sim {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// What a mode may reach in a step. Semi-implicit Euler, which damps with the speeds before the step, explodes from
/// h^2 lambda + 2 h c = 4 on, c being what damps the mode over its mass; in other postures modes are faster.
constexpr double kMost = 2.4;

/// @return squares of the circular frequencies, in increasing order [1/s^2]
VectorXd squared_frequencies(const MatrixXd& stiffness, const MatrixXd& mass) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd>(stiffness, mass, Eigen::EigenvaluesOnly)
      .eigenvalues();
}

/// @param rotors  mass matrix of the rotors @return squared frequency of the fastest mode, rotors free [1/s^2]
double fastest(const AxisVector& stiffness, const AxisMatrix& links, const MatrixXd& rotors) {
  const auto n = stiffness.size();
  const MatrixXd K = stiffness.asDiagonal();
  MatrixXd both = MatrixXd::Zero(2 * n, 2 * n), mass = both;
  both << K, -K, -K, K;
  mass.topLeftCorner(n, n) = links;
  mass.bottomRightCorner(n, n) = rotors;
  return squared_frequencies(both, mass)(2 * n - 1);
}

[[noreturn]] void refuse(const ElasticityParameters& p, double h) {
  throw FaultError(
      FaultCode::bad_configuration,
      fmt::format(
          "sim.robots.ARM.elasticity: gears of {:g} Hz with a damping ratio of {:g} are too fast for an "
          "integration step of {:g} ms",
          p.frequency, p.damping, 1000 * h),
      "raise sim.substeps, or lower sim.robots.ARM.elasticity_damping or .elasticity");
}

}  // namespace

ElasticGears::ElasticGears(const ElasticityParameters& p, const ArmAtRest& arm,
                           std::span<const MotorParameters> motors, const AxisMatrix& motors_per_joints,
                           double h)
    : rotors_(arm.joints.size()), brakes_(arm.joints.size()), h_(h) {
  if (!(p.frequency > 0 && p.damping >= 0 && p.damping <= 1))
    throw std::invalid_argument("world: elastic gears need a frequency, and a damping ratio of 0 to 1");
  for (int k = 0; k < rotors_.size(); ++k) {
    const MotorParameters& m = motors[static_cast<std::size_t>(k)];
    rotors_[k] = (1 - kGearShare) * m.rotor_inertia;
    brakes_[k] = m.brake_torque;
  }
  const MatrixXd at_joints = motors_per_joints.transpose() * rotors_.asDiagonal() * motors_per_joints;
  stiffness_ = arm.mass.diagonal() + AxisVector(at_joints.diagonal());
  const double omega = 2 * std::numbers::pi * p.frequency;
  stiffness_ *= omega * omega / squared_frequencies(stiffness_.asDiagonal(), arm.mass)(0);
  damping_ = 2 * p.damping / omega * stiffness_;
  const double lambda = fastest(stiffness_, arm.mass, at_joints);
  if (!(h * lambda * (h + 4 * p.damping / omega) < kMost)) refuse(p, h);
  joints_ = arm.joints + arm.holding.cwiseQuotient(stiffness_);
  shaft_speeds_ = AxisVector::Zero(arm.joints.size());
}

AxisVector ElasticGears::step(const AxisVector& joints, const AxisVector& speeds, const AxisVector& torques,
                              bool braked, const AxisMatrix& motors_per_joints) {
  const Eigen::PartialPivLU<AxisMatrix> gear(motors_per_joints);
  const AxisVector rotor_speeds = gear.solve(shaft_speeds_);
  AxisVector springs =
      stiffness_.cwiseProduct(joints_ - joints) + damping_.cwiseProduct(rotor_speeds - speeds);
  const AxisVector load = gear.transpose().solve(springs);
  shaft_speeds_ += h_ * (torques - load).cwiseQuotient(rotors_);
  if (braked) {
    const AxisVector most = h_ * brakes_.cwiseQuotient(rotors_);
    shaft_speeds_ -= shaft_speeds_.cwiseMax(-most).cwiseMin(most);
  }
  joints_ += h_ * gear.solve(shaft_speeds_);
  return springs;
}

}  // namespace mrroc::sim
