#include "base/screw.hpp"

#include <cmath>

namespace mrroc {

Pose exp_screw(const Twist& v, double time) {
  const Vector3 aa = v.angular() * time;
  const double angle = aa.norm();
  const Matrix3 S = skew(aa);
  const bool small = angle < 1e-3;
  const double b = small ? 0.5 : (1 - std::cos(angle)) / (angle * angle);
  const double c = small ? 1. / 6 : (angle - std::sin(angle)) / (angle * angle * angle);
  const Matrix3 V = Matrix3::Identity() + b * S + c * S * S;
  return {rotation_from_angle_axis(aa), V * v.linear() * time};
}

Twist log_screw(const Pose& T) {
  const Vector3 aa = angle_axis_from_rotation(T.R);
  const double angle = aa.norm();
  const Matrix3 S = skew(aa);
  // (1 - angle/2 cot(angle/2)) / angle^2, which has no singularity up to a full turn.
  const double half = angle / 2;
  const double d = angle < 1e-2 ? 1. / 12 + angle * angle / 720
                                : (1 - half * std::cos(half) / std::sin(half)) / (angle * angle);
  return Twist::from((Matrix3::Identity() - 0.5 * S + d * S * S) * T.p, aa);
}

}  // namespace mrroc
