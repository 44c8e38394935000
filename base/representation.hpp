// The five representations of a pose at the interface of an effector driver (MG tab. 1), and the operators
// A_X between them and homogeneous matrices.
#pragma once
#include <optional>

#include "base/axes.hpp"
#include "base/effector_command.hpp"
#include "base/pose.hpp"

namespace mrroc {

/// Position [m] and Euler angles ZYZ [rad]: the papers' r_(E). R = R_z(phi) R_y(theta) R_z(psi).
using EulerZyzPose = Vector6;

/// The operator A_E: r_(E) -> homogeneous matrix. Real-time safe.
Pose pose_from_euler_zyz(const EulerZyzPose& r);

/// The operator A_E^-1. theta lies in [0, pi]. Where theta is 0 or pi only the sum or the difference of the
/// other two is defined: psi is 0 there. Real-time safe.
EulerZyzPose euler_zyz_from_pose(const Pose& T);

/// @return whether the numbers are one per axis (motors, joints) and no pose in space
constexpr bool per_axis(Representation r) {
  return r == Representation::motors || r == Representation::joints;
}

/// @param axes of the robot
/// @return how many of the sixteen numbers count; 0 for a number that is no representation
constexpr int numbers_used(Representation r, int axes) {
  switch (r) {
    case Representation::motors:
    case Representation::joints:
      return axes;
    case Representation::frame:
      return 16;
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis:
      return 6;
  }
  return 0;
}

/// A_X for the three representations of a pose in space.
/// @param r  frame, xyz_euler_zyz or xyz_angle_axis
/// @return the pose; nothing when a number is not finite, when a frame is no homogeneous matrix with a
/// rotation
///         to within 1e-6, or when r is another representation. Real-time safe
std::optional<Pose> pose_from_numbers(Representation r, const PoseNumbers& numbers);

/// A_X^-1 for the same three.
/// @return the numbers, those that do not count are 0; all 0 when r is another representation. Real-time safe
PoseNumbers numbers_from_pose(Representation r, const Pose& T);

/// @return the first `axes` numbers as a vector. Real-time safe
AxisVector axes_from_numbers(const PoseNumbers& numbers, int axes);
/// @return the entries as numbers, followed by 0. Real-time safe
PoseNumbers numbers_from_axes(const AxisVector& positions);

}  // namespace mrroc
