#include "vsp/odometry/motion.hpp"

#include <algorithm>
#include <cmath>

#include "vsp/least_squares.hpp"
#include "vsp/odometry/consensus.hpp"
#include "vsp/odometry/reprojection.hpp"

namespace mrroc::vsp {
namespace {

constexpr double kHuber = 1;  // error of a place from which on the loss grows linearly [pixel]
constexpr int kSteps = 10;
constexpr double kMostDamping = 1e3;
constexpr double kLeastNoise = 0.05;  // standard deviation of a coordinate that is believed [pixel]
/// Errors of the four coordinates of a place, and of neighbouring features, are alike: the variance of the motion is this
/// many times that of independent errors. Measured on pictures whose motion is known.
constexpr double kDependent = 2;

/// What vsp/least_squares.hpp needs.
struct Reprojection {
  const StereoRig& rig;
  const std::vector<StereoMatch>& matches;
  const std::vector<std::size_t>& chosen;

  [[nodiscard]] double cost(const Pose& A) const {
    double sum = 0;
    for (const std::size_t k : chosen) {
      const double e = (reprojected(rig, A, matches[k].point) - matches[k].seen).norm();
      sum += e < kHuber ? e * e : kHuber * (2 * e - kHuber);
    }
    return sum;
  }
  void linearise(const Pose& A, Matrix6& JtJ, Vector6& Jtr) const {
    JtJ.setZero();
    Jtr.setZero();
    StereoJacobian J;
    for (const std::size_t k : chosen) {
      const StereoPlace r = reprojected(rig, A, matches[k].point, &J) - matches[k].seen;
      const double weight = std::min(1.0, kHuber / r.norm());
      JtJ += weight * J.transpose() * J;
      Jtr += weight * J.transpose() * r;
    }
  }
  [[nodiscard]] static Pose moved(const Pose& A, const Vector6& e) { return vsp::moved(A, e); }
};

/// Mean square of the coordinates' errors. @param count  of the places
double variance(double cost, std::size_t count) {
  constexpr double kUnknowns = 6;
  return cost / std::max(1.0, 4 * static_cast<double>(count) - kUnknowns);
}

}  // namespace

StereoMotion refined(const StereoRig& rig, const std::vector<StereoMatch>& matches, const Pose& A) {
  StereoMotion motion;
  motion.A = A;
  double cost = 0;
  for (int pass = 0; pass < 2; ++pass) {
    motion.inliers = inliers(rig, matches, motion.A);
    cost = minimise<6>(Reprojection{rig, matches, motion.inliers}, motion.A, kSteps, kMostDamping);
  }
  const double noise = variance(cost, motion.inliers.size());
  // Where matches are lost at the bound of the inliers, the errors of those that are left are cut off there, too.
  const double cut =
      static_cast<double>(matches.size()) / std::max(1.0, static_cast<double>(motion.inliers.size()));
  motion.rms_px = std::sqrt(2 * noise);  // of a place in one picture, which has two coordinates
  Matrix6 H;
  Vector6 gradient;
  Reprojection{rig, matches, motion.inliers}.linearise(motion.A, H, gradient);
  motion.covariance =
      kDependent * cut * std::max(noise, kLeastNoise * kLeastNoise) * H.ldlt().solve(Matrix6::Identity());
  motion.covariance = 0.5 * (motion.covariance + motion.covariance.transpose()).eval();
  return motion;
}

}  // namespace mrroc::vsp
