#include "tasks/visual_servo/aggregation.hpp"

#include <Eigen/Cholesky>

#include "base/screw.hpp"

namespace mrroc::visual_servo {
namespace {

Vector6 log_of(const Pose& T) { return log_screw(T).vector(); }
Pose exp_of(const Vector6& r) { return exp_screw(Twist::from(r.head<3>(), r.tail<3>())); }

CameraError weighted(const CameraError& a, const CameraError& b) {
  const Eigen::LLT<Matrix6> sum(a.covariance + b.covariance);
  if (sum.info() != Eigen::Success) return aggregate(Aggregation::mean, a, b);
  const Matrix6 share = sum.solve(a.covariance).transpose();  // of b: A (A + B)^-1
  CameraError result{a.e * exp_of(share * log_of(a.e.inverse() * b.e)), Matrix6()};
  const Matrix6 covariance = share * b.covariance;
  result.covariance = 0.5 * (covariance + covariance.transpose());
  return result;
}

}  // namespace

double length_of(const Pose& e) {
  return std::hypot(e.p.norm(), kLever * angle_axis_from_rotation(e.R).norm());
}

CameraError aggregate(Aggregation method, const CameraError& a, const CameraError& b) {
  switch (method) {
    case Aggregation::mean:
      return {a.e * exp_of(0.5 * log_of(a.e.inverse() * b.e)), 0.25 * (a.covariance + b.covariance)};
    case Aggregation::switching:
      return length_of(b.e) < length_of(a.e) ? b : a;
    case Aggregation::weights:
      return weighted(a, b);
  }
  return a;
}

}  // namespace mrroc::visual_servo
