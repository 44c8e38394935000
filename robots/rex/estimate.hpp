// What an estimator of Rex answers.
#pragma once
#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// @param belief  of the window's newest stage  @param window  not empty
/// @return the answer, about B. Real-time safe
[[nodiscard]] edp::EstimatorResult result_of(const StageBelief& belief, const StageWindow& window,
                                             const edp::Health& health) noexcept;

/// @return the answer before anything has begun: not ok. Real-time safe
[[nodiscard]] edp::EstimatorResult no_result() noexcept;

/// @return covariance of the pose of B. Real-time safe
[[nodiscard]] Eigen::Matrix3d pose_covariance(const StageBelief& belief,
                                              const Eigen::Vector2d& centre) noexcept;

/// @param z  state of the stage  @param covariance  of the pose of B there  @param times  the ellipse is as large
/// @return whether the map pose of the stage is outside the ellipse that holds 99.9 % of what is to be expected.
///         Real-time safe
[[nodiscard]] bool beyond_ellipse(const WindowStage& stage, const StageVector& z,
                                  const Eigen::Matrix3d& covariance, const Eigen::Vector2d& centre,
                                  double times = 1) noexcept;

}  // namespace mrroc::rex
