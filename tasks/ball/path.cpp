#include "tasks/ball/path.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::ball {

using std::numbers::pi;

Matrix3 palm_orientation(std::size_t arm) {
  Matrix3 R;
  R.col(0) = Vector3::UnitZ();
  R.col(2) = arm == 0 ? Vector3(-kLine) : kLine;
  R.col(1) = R.col(2).cross(R.col(0));
  return R;
}

double smooth(double u) {
  u = std::clamp(u, 0.0, 1.0);
  return u * u * u * (10 + u * (6 * u - 15));
}

double circle_angle(const Parameters& k, double age) {
  const double speed = 2 * pi / k.turn;
  const double last = duration(k, kCircle);
  age = std::clamp(age, 0.0, last);
  // The mean of the speed while it grows is a half.
  const auto grown = [&](double t) {
    const double u = std::clamp(t / kSpeedUp, 0.0, 1.0);
    return kSpeedUp * u * u * u * (1 - u / 2) + std::max(t - kSpeedUp, 0.0);
  };
  if (age <= last / 2) return speed * grown(age);
  return 2 * pi - speed * grown(last - age);
}

double duration(const Parameters& k, int m) { return m == kCircle ? k.turn + kSpeedUp : kLiftTime; }

Vector3 path(const Parameters& k, int m, double age) {
  const Vector3 up = Vector3::UnitZ();
  if (m < kLift) return Vector3::Zero();
  if (m == kLift) return k.lift * smooth(age / kLiftTime) * up;
  if (m == kWeigh) return k.lift * up;
  if (m == kCircle) {
    const double angle = circle_angle(k, age);
    return (k.lift + k.radius * (1 - std::cos(angle))) * up + k.radius * std::sin(angle) * kLine.cross(up);
  }
  if (m == kLower) return (k.lift - (k.lift + kBelow) * smooth(age / kLiftTime)) * up;
  return Vector3::Zero();
}

}  // namespace mrroc::ball
