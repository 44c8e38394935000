#include "tasks/calibrate_cell/fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::calibrate_cell {
namespace {

constexpr int kUnknowns = 4;  // of a ball
constexpr double kLeastShare =
    0.15;  // least over largest singular value of the directions in which a ball was touched
constexpr double kLeastSpread = 0.02;  // [m] of points across the line that fits them best, rms

Eigen::MatrixXd directions(std::span<const Vector3> points, const Vector3& centre) {
  Eigen::MatrixXd J(static_cast<Eigen::Index>(points.size()), kUnknowns);
  for (Eigen::Index k = 0; k < J.rows(); ++k) {
    const Vector3 n = (points[static_cast<std::size_t>(k)] - centre).normalized();
    J.row(k) << -n.transpose(), -1;
  }
  return J;
}

Eigen::VectorXd deviations(std::span<const Vector3> points, const Vector3& centre, double radius) {
  Eigen::VectorXd r(static_cast<Eigen::Index>(points.size()));
  for (Eigen::Index k = 0; k < r.size(); ++k)
    r[k] = (points[static_cast<std::size_t>(k)] - centre).norm() - radius;
  return r;
}

Vector3 mean_of(std::span<const Vector3> points) {
  Vector3 sum = Vector3::Zero();
  for (const Vector3& p : points) sum += p;
  return sum / static_cast<double>(points.size());
}

}  // namespace

std::optional<BallFit> fit_ball(std::span<const Vector3> points, const Vector3& near, double radius) {
  constexpr int kSteps = 20;
  if (points.size() < kUnknowns) return {};
  BallFit fit{near, radius, 0};
  for (int step = 0; step < kSteps; ++step) {
    const Eigen::MatrixXd J = directions(points, fit.centre);
    if (!J.allFinite()) return {};
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
    const auto& s = svd.singularValues();
    if (!(s[kUnknowns - 1] > kLeastShare * s[0])) return {};
    const Eigen::Vector4d d = svd.solve(-deviations(points, fit.centre, fit.radius));
    fit.centre += d.head<3>();
    fit.radius += d[3];
  }
  if (!fit.centre.allFinite() || !(fit.radius > 0)) return {};
  const auto more = static_cast<double>(points.size() - kUnknowns);
  if (more > 0) fit.rms = std::sqrt(deviations(points, fit.centre, fit.radius).squaredNorm() / more);
  return fit;
}

std::optional<PoseFit> fit_pose(std::span<const Vector3> in_A, std::span<const Vector3> in_B) {
  const std::size_t n = in_A.size();
  if (n < 3 || in_B.size() != n) return {};
  const Vector3 a = mean_of(in_A), b = mean_of(in_B);
  Matrix3 covariance = Matrix3::Zero(), scatter = Matrix3::Zero();
  for (std::size_t k = 0; k < n; ++k) {
    covariance += (in_A[k] - a) * (in_B[k] - b).transpose();
    scatter += (in_B[k] - b) * (in_B[k] - b).transpose();
  }
  const Vector3 spread =
      Eigen::SelfAdjointEigenSolver<Matrix3>(scatter / static_cast<double>(n)).eigenvalues();
  if (!(spread[1] > kLeastSpread * kLeastSpread)) return {};
  const Eigen::JacobiSVD<Matrix3> svd(covariance, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3 mirror = Matrix3::Identity();
  mirror(2, 2) = (svd.matrixU() * svd.matrixV().transpose()).determinant() < 0 ? -1 : 1;
  PoseFit fit;
  fit.T_AB.R = orthonormal(svd.matrixU() * mirror * svd.matrixV().transpose());
  fit.T_AB.p = a - fit.T_AB.R * b;
  if (!fit.T_AB.p.allFinite()) return {};
  for (std::size_t k = 0; k < n; ++k) {
    fit.residuals.push_back((fit.T_AB * in_B[k] - in_A[k]).norm());
    fit.rms += fit.residuals.back() * fit.residuals.back();
  }
  fit.rms = std::sqrt(fit.rms / static_cast<double>(n));
  return fit;
}

PoseDistance distance(const Pose& A, const Pose& B) {
  return {1e3 * (A.p - B.p).norm(),
          angle_axis_from_rotation(A.R.transpose() * B.R).norm() * 180 / std::numbers::pi};
}

}  // namespace mrroc::calibrate_cell
