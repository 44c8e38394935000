#include "base/representation.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc {
namespace {

Matrix3 about_z(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Matrix3 R;
  R << c, -s, 0, s, c, 0, 0, 0, 1;
  return R;
}

Matrix3 about_y(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  Matrix3 R;
  R << c, 0, s, 0, 1, 0, -s, 0, c;
  return R;
}

Vector6 first_six(const PoseNumbers& numbers) { return Eigen::Map<const Vector6>(numbers.data()); }

PoseNumbers numbers_from(const Vector6& r) {
  PoseNumbers numbers{};
  std::copy_n(r.data(), 6, numbers.begin());
  return numbers;
}

using FrameMap = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;

std::optional<Pose> pose_from_frame(const PoseNumbers& numbers) {
  const Eigen::Map<const FrameMap> frame(numbers.data());
  if (!(frame.row(3) == Eigen::RowVector4d(0, 0, 0, 1))) return std::nullopt;
  const Pose T{frame.topLeftCorner<3, 3>(), frame.topRightCorner<3, 1>()};
  if (!is_proper(T)) return std::nullopt;
  return Pose{orthonormal(T.R), T.p};
}

}  // namespace

Pose pose_from_euler_zyz(const EulerZyzPose& r) {
  return {about_z(r[3]) * about_y(r[4]) * about_z(r[5]), r.head<3>()};
}

EulerZyzPose euler_zyz_from_pose(const Pose& T) {
  const Matrix3& R = T.R;
  const double s = std::hypot(R(0, 2), R(1, 2));
  // Below this the z axes are parallel to rounding, and the columns of R give phi and psi only together.
  const bool parallel = s < 1e-9;
  const double phi = parallel ? std::atan2(R(1, 0), R(0, 0)) + (R(2, 2) < 0 ? std::numbers::pi : 0)
                              : std::atan2(R(1, 2), R(0, 2));
  EulerZyzPose r;
  r << T.p, std::remainder(phi, 2 * std::numbers::pi), std::atan2(s, R(2, 2)),
      parallel ? 0 : std::atan2(R(2, 1), -R(2, 0));
  return r;
}

std::optional<Pose> pose_from_numbers(Representation r, const PoseNumbers& numbers) {
  Pose T;
  switch (r) {
    case Representation::frame:
      return pose_from_frame(numbers);
    case Representation::xyz_euler_zyz:
      T = pose_from_euler_zyz(first_six(numbers));
      break;
    case Representation::xyz_angle_axis:
      T = pose_from_angle_axis(first_six(numbers));
      break;
    case Representation::motors:
    case Representation::joints:
    default:
      return std::nullopt;
  }
  if (!is_proper(T)) return std::nullopt;
  return T;
}

PoseNumbers numbers_from_pose(Representation r, const Pose& T) {
  PoseNumbers numbers{};
  switch (r) {
    case Representation::frame: {
      Eigen::Map<FrameMap> frame(numbers.data());
      frame.topLeftCorner<3, 3>() = T.R;
      frame.topRightCorner<3, 1>() = T.p;
      frame(3, 3) = 1;
      break;
    }
    case Representation::xyz_euler_zyz:
      return numbers_from(euler_zyz_from_pose(T));
    case Representation::xyz_angle_axis:
      return numbers_from(angle_axis_from_pose(T));
    case Representation::motors:
    case Representation::joints:
      break;
  }
  return numbers;
}

AxisVector axes_from_numbers(const PoseNumbers& numbers, int axes) {
  return Eigen::Map<const AxisVector>(numbers.data(), axes);
}

PoseNumbers numbers_from_axes(const AxisVector& positions) {
  PoseNumbers numbers{};
  std::copy_n(positions.data(), positions.size(), numbers.begin());
  return numbers;
}

}  // namespace mrroc
