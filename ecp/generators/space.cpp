#include "ecp/generators/space.hpp"

#include <cmath>
#include <numbers>

#include "base/representation.hpp"

namespace mrroc::ecp {
namespace {

using std::numbers::pi;

double whole_turns(double angle) { return 2 * pi * std::round(angle / (2 * pi)); }

Vector3 near_rotation(const Vector3& aa, const Vector3& before) {
  const double angle = aa.norm();
  // Without an axis of its own it may be any number of whole turns about the axis before.
  const Vector3 axis = angle > 1e-9 ? Vector3(aa / angle) : before.normalized();
  if (!axis.allFinite() || axis.isZero(0)) return aa;
  return aa + whole_turns(axis.dot(before - aa)) * axis;
}

Vector3 near_euler(const Vector3& euler, const Vector3& before) {
  const auto turned = [&](Vector3 e) {
    for (int k = 0; k < 3; ++k) e[k] += whole_turns(before[k] - e[k]);
    return e;
  };
  const Vector3 one = turned(euler);
  const Vector3 other = turned({euler[0] + pi, -euler[1], euler[2] + pi});
  return (one - before).squaredNorm() <= (other - before).squaredNorm() ? one : other;
}

}  // namespace

MotionLimits default_limits(Representation space, int axes) {
  if (space == Representation::motors)
    return {Coordinates::Constant(axes, 200), Coordinates::Constant(axes, 150)};
  if (space == Representation::joints)
    return {Coordinates::Constant(axes, 1.5), Coordinates::Constant(axes, 7)};
  MotionLimits limits{Coordinates(6), Coordinates::Constant(6, 5)};
  limits.velocity << 0.5, 0.5, 0.5, 2, 2, 2;
  return limits;
}

Coordinates nearest_coordinates(Representation space, const Coordinates& pose, const Coordinates& before) {
  Coordinates near = pose;
  if (space == Representation::xyz_angle_axis)
    near.tail<3>() = near_rotation(pose.tail<3>(), before.tail<3>());
  if (space == Representation::xyz_euler_zyz) near.tail<3>() = near_euler(pose.tail<3>(), before.tail<3>());
  return near;
}

std::vector<Coordinates> accumulated(Representation space, const std::vector<Coordinates>& increments) {
  std::vector<Coordinates> poses;
  if (increments.empty()) return poses;
  poses.emplace_back(Coordinates::Zero(increments.front().size()));
  Pose T;
  for (const Coordinates& increment : increments) {
    if (per_axis(space)) {
      poses.emplace_back(poses.back() + increment);
      continue;
    }
    T = T * pose_from_numbers(space, numbers_from_axes(increment)).value_or(Pose{});
    const Coordinates numbers = axes_from_numbers(numbers_from_pose(space, T), 6);
    poses.push_back(nearest_coordinates(space, numbers, poses.back()));
  }
  return poses;
}

}  // namespace mrroc::ecp
