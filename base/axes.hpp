// Vectors with one entry per axis of a robot: joints, motors, encoders.
#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>

namespace mrroc {

/// Most axes that one effector may have.
inline constexpr int kMaxAxes = 8;

/// One number per axis of a robot, at most kMaxAxes; its storage is inside, so it never allocates.
using AxisVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxAxes, 1>;
/// Square matrix over the axes of a robot, storage inside.
using AxisMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxAxes, kMaxAxes>;
/// Velocities of all axes to the velocity of a body, storage inside.
using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMaxAxes>;

}  // namespace mrroc
