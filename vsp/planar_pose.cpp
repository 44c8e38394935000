#include "vsp/planar_pose.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "vsp/least_squares.hpp"
#include "vsp/opencv.hpp"

namespace mrroc::vsp {
namespace {

using Matrix2x3 = Eigen::Matrix<double, 2, 3>;
using Matrix2x6 = Eigen::Matrix<double, 2, 6>;

// Derivative of project() by the point in C.
Matrix2x3 projection_jacobian(const CameraModel& camera, const Vector3& q) {
  const auto& [k1, k2, p1, p2, k3] = camera.distortion;
  const double x = q.x() / q.z();
  const double y = q.y() / q.z();
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double slope = 2 * (k1 + r2 * (2 * k2 + 3 * r2 * k3));  // d radial / d r2, times 2
  Eigen::Matrix2d lens;
  lens << radial + x * x * slope + 2 * p1 * y + 6 * p2 * x, x * y * slope + 2 * p1 * x + 2 * p2 * y,
      x * y * slope + 2 * p1 * x + 2 * p2 * y, radial + y * y * slope + 6 * p1 * y + 2 * p2 * x;
  Matrix2x3 pinhole;
  pinhole << 1 / q.z(), 0, -x / q.z(), 0, 1 / q.z(), -y / q.z();
  return Eigen::Vector2d(camera.fx, camera.fy).asDiagonal() * lens * pinhole;
}

struct Problem {
  const CameraModel& camera;
  std::span<const Vector3> points;
  std::span<const Vector2> pixels;

  // Sum of squares, or infinity when a point is not in front of the camera.
  [[nodiscard]] double cost(const Pose& T) const {
    double sum = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector3 q = T * points[k];
      if (q.z() < 1e-3) return std::numeric_limits<double>::infinity();
      sum += (project(camera, q) - pixels[k]).squaredNorm();
    }
    return sum;
  }

  [[nodiscard]] static Pose moved(const Pose& T, const Vector6& step) {
    return {rotation_from_angle_axis(step.tail<3>()) * T.R, T.p + step.head<3>()};
  }

  void linearise(const Pose& T, Matrix6& JtJ, Vector6& Jtr) const {
    JtJ.setZero();
    Jtr.setZero();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Vector3 arm = T.R * points[k];
      const Matrix2x3 P = projection_jacobian(camera, arm + T.p);
      Matrix2x6 J;
      J << P, -P * skew(arm);
      JtJ += J.transpose() * J;
      Jtr += J.transpose() * (project(camera, arm + T.p) - pixels[k]);
    }
  }
};

PlanarPose minimum_from(const Problem& problem, Pose T, double noise_px) {
  constexpr int kSteps = 30;
  const double cost = minimise<6>(problem, T, kSteps, 1e6);
  PlanarPose found;
  found.T_CG = {orthonormal(T.R), T.p};
  const auto n = static_cast<double>(problem.points.size());
  found.rms_px = std::sqrt(cost / n);
  if (!std::isfinite(cost)) return found;
  for (std::size_t k = 0; k < problem.points.size(); ++k)
    found.worst_px =
        std::max(found.worst_px, (project(problem.camera, T * problem.points[k]) - problem.pixels[k]).norm());
  Matrix6 JtJ;
  Vector6 Jtr;
  problem.linearise(T, JtJ, Jtr);
  const double freedom = 2 * n - 6;
  found.covariance = std::max(cost / freedom, noise_px * noise_px) * JtJ.ldlt().solve(Matrix6::Identity());
  return found;
}

std::vector<Pose> both_starts(const Problem& problem) {
  std::vector<cv::Point3d> points;
  std::vector<cv::Point2d> pixels;
  for (const Vector3& p : problem.points) points.emplace_back(p.x(), p.y(), p.z());
  for (const Vector2& p : problem.pixels) pixels.emplace_back(p.x(), p.y());
  std::vector<cv::Mat> rotations;
  std::vector<cv::Mat> translations;
  try {
    cv::solvePnPGeneric(points, pixels, camera_matrix(problem.camera), distortion(problem.camera), rotations,
                        translations, false, cv::SOLVEPNP_IPPE);
  } catch (const cv::Exception&) {
    return {};  // the points lie on a line
  }
  std::vector<Pose> starts;
  for (std::size_t k = 0; k < rotations.size(); ++k) {
    const auto vector = [](const cv::Mat& m) {
      return Vector3(m.at<double>(0), m.at<double>(1), m.at<double>(2));
    };
    const Pose T{rotation_from_angle_axis(vector(rotations[k])), vector(translations[k])};
    if (T.R.allFinite() && T.p.allFinite()) starts.push_back(T);
  }
  return starts;
}

}  // namespace

std::optional<PlanarPoses> planar_pose(const CameraModel& camera, std::span<const Vector3> points,
                                       std::span<const Vector2> pixels,
                                       const PlanarPoseParameters& parameters) {
  if (points.size() < 4 || points.size() != pixels.size()) return std::nullopt;
  const Problem problem{camera, points, pixels};
  std::vector<PlanarPose> minima;
  for (const Pose& start : both_starts(problem)) {
    const PlanarPose found = minimum_from(problem, start, parameters.noise_px);
    // The object's face looks at the camera, or it could not be seen.
    if (std::isfinite(found.rms_px) && found.covariance.allFinite() &&
        found.T_CG.R.col(2).dot(found.T_CG.p) < 0)
      minima.push_back(found);
  }
  if (minima.empty()) return std::nullopt;
  std::ranges::sort(minima, {}, &PlanarPose::rms_px);
  PlanarPoses result{minima.front(), std::nullopt, false};
  const auto other = std::ranges::find_if(minima, [&](const PlanarPose& p) {
    return angle_axis_from_rotation(result.best.T_CG.R.transpose() * p.T_CG.R).norm() >=
           parameters.same_angle;
  });
  if (other == minima.end()) return result;
  result.other = *other;
  const auto n = static_cast<double>(points.size());
  const auto squares = [n](const PlanarPose& p) { return n * p.rms_px * p.rms_px; };
  const double variance =
      std::max(squares(result.best) / (2 * n - 6), parameters.noise_px * parameters.noise_px);
  result.ambiguous = squares(*other) - squares(result.best) < parameters.significance * variance;
  return result;
}

}  // namespace mrroc::vsp
