// One stage of the window of an estimator of Rex: what was measured there, and what led there.
#pragma once
#include <Eigen/Core>
#include <cstdint>

#include "robots/rex/planar_factor.hpp"

namespace mrroc::rex {

/// Numbers of z = (x, p, c): x of the model (pose of the centre of mass on M, its velocity along B, speeds of the wheels),
/// slip coefficients p = (mu_x, mu_y, split), and the clone c: the pose at the last picture, so that odometry relates two
/// states of the same stage.
inline constexpr int kStageStates = 16;
/// Numbers of z that have process noise: x and p.
inline constexpr int kStageNoises = 13;
/// Where p and c begin in z.
inline constexpr int kSlipIndex = 10;
inline constexpr int kCloneIndex = 13;

using StageVector = Eigen::Matrix<double, kStageStates, 1>;
using StageMatrix = Eigen::Matrix<double, kStageStates, kStageStates>;
using NoiseVector = Eigen::Matrix<double, kStageNoises, 1>;

/// A stage. Trivially copyable.
struct WindowStage {
  std::int64_t step{};  ///< of its reading

  Eigen::Vector4d torque;  ///< from the stage before to this one [N m]
  Eigen::Vector4d load;    ///< then, of the wheels [N]
  bool torque_known{};     ///< false: the drives braked then, or nobody told

  Eigen::Vector4d theta;        ///< turned by the wheels since power-up [rad]
  bool wheels_valid{};          ///< wheel_speed is a measurement
  Eigen::Vector4d wheel_speed;  ///< [rad/s]
  bool imu_valid{};             ///< yaw and yaw_rate are measurements
  double yaw{};                 ///< of the IMU, without the offset to the map [rad]
  double yaw_rate{};            ///< without bias [rad/s]

  bool picture{};              ///< behind it c is its pose
  PlanarFactor map;            ///< pose of B on M at `map_delay` after this stage
  double map_delay{};          ///< within half a stage [s]
  PlanarFactor odometry;       ///< motion of B from the picture `step_before` to this stage, in B of then
  std::int64_t step_before{};  ///< of that picture
};

}  // namespace mrroc::rex
