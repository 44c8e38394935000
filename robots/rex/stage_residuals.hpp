// What the measurements of a stage say about its state.
#pragma once
#include "robots/rex/estimator_noise.hpp"
#include "robots/rex/window_stage.hpp"

namespace mrroc::rex {

/// Most residuals of a stage: four wheels, yaw rate, yaw, map, odometry.
inline constexpr int kMostResiduals = 12;

/// Residuals of a stage, each divided by its standard deviation, and how they depend on z. Only the first `count` rows
/// mean something.
struct StageResiduals {
  Eigen::Matrix<double, kMostResiduals, kStageStates> H;  ///< d r / d z
  Eigen::Matrix<double, kMostResiduals, 1> r;             ///< what the state says minus what was measured
  int count{};                                            ///< of rows, 0..kMostResiduals
};

/// Where B is and was, seen from the model's state, which is about the centre of mass.
struct PlanarPrediction {
  Eigen::Vector3d value;                         ///< x, y [m], phi [rad]
  Eigen::Matrix<double, 3, kStageStates> slope;  ///< d value / d z
};

/// @param centre  of mass in B [m]  @param delay  [s], short  @return pose of B on M that long after the stage
[[nodiscard]] PlanarPrediction pose_of_body(const StageVector& z, const Eigen::Vector2d& centre,
                                            double delay) noexcept;

/// @param centre  of mass in B [m]  @return motion of B since the clone, in B of then
[[nodiscard]] PlanarPrediction motion_of_body(const StageVector& z, const Eigen::Vector2d& centre) noexcept;

/// @param yaw_offset  heading on the map minus yaw of the IMU [rad]  @param centre  of mass in B [m]
/// @return residuals of everything that was measured at the stage; angles are taken the short way round. Real-time safe
[[nodiscard]] StageResiduals residuals(const StageVector& z, const WindowStage& stage, double yaw_offset,
                                       const Eigen::Vector2d& centre, const EstimatorNoise& noise) noexcept;

}  // namespace mrroc::rex
