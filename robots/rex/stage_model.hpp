// How the state of an estimator of Rex goes from one stage of its window to the next.
#pragma once
#include "robots/rex/estimator_noise.hpp"
#include "robots/rex/model.hpp"
#include "robots/rex/window_stage.hpp"

namespace mrroc::rex {

/// The next stage's state, and how it depends on the present one and on noise: z' = z + F dz + (diag(deviation) w, 0).
struct StageTransition {
  StageVector z;          ///< the next stage's, in units of kStageStates
  StageMatrix F;          ///< its derivative by the present z
  NoiseVector deviation;  ///< standard deviations of the process noise of x and p
};

/// @param z  of `from`  @param from, to  neighbours in the window: what led to `to` stands there; behind a picture the
///                clone becomes the pose of `from`
/// @param weighed  the platform at rest
/// @return the state of `to`; finite when z is within contained(). Only where the wheels slide
///         does anything depend on slip coefficients: below that, forces tell of mu / v_s alone, and v_s, which is the
///         model's own, would be learnt as friction. Rolling wheels do not see the ground, which may become another one:
///         the coefficients have more noise then. At rest and while the drives brake they have none. Real-time safe
[[nodiscard]] StageTransition transition(const StageVector& z, const WindowStage& from, const WindowStage& to,
                                         const Load& weighed, const EstimatorNoise& noise) noexcept;

/// @return z with slip coefficients within their bounds, and velocities and position within what any platform can have: 20
///         m/s, 50 rad/s, 300 rad/s of the wheels, 100 km. Real-time safe
[[nodiscard]] StageVector contained(const StageVector& z) noexcept;

/// @return a - b, headings the short way round. Real-time safe
[[nodiscard]] StageVector difference(const StageVector& a, const StageVector& b) noexcept;

}  // namespace mrroc::rex
