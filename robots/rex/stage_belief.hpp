// What is believed of a stage's state: the extended Kalman filter that the estimators of Rex share. It is the second
// algorithm itself, the arrival cost of the first, and the covariance of its newest stage.
#pragma once
#include "edp/platform/platform.hpp"
#include "robots/rex/stage_window.hpp"

namespace mrroc::rex {

/// A normal distribution of z. Trivially copyable.
struct StageBelief {
  StageVector z;  ///< mean [m, rad, m/s, rad/s; slip coefficients 1], in the order of kStageStates
  StageMatrix P;  ///< covariance, in products of these units
};

/// @param window  that has begun with what was found  @return the belief when the platform has stood still: finite
///                whatever was found. Real-time safe
[[nodiscard]] StageBelief standing_belief(const edp::StandingStill& found,
                                          const StageWindow& window) noexcept;

/// Takes the measurements of a stage in. Real-time safe.
/// @param at, linearised  residuals and the state for which they were made
void correct(StageBelief& belief, const StageResiduals& at, const StageVector& linearised) noexcept;

/// Goes to the next stage. Noise does not make slip coefficients less certain than EstimatorPrior::most_slip. Real-time
/// safe.
/// @param to, linearised  transition and the state for which it was made
void predict(StageBelief& belief, const StageTransition& to, const StageVector& linearised) noexcept;

}  // namespace mrroc::rex
