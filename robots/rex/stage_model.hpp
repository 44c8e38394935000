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
/// @return the state of `to`; finite when z is within contained(). At rest and while the drives brake, slip coefficients get
///         no noise and nothing is said to depend on them: else a platform that stands for minutes would find that the
///         ground holds it well. Real-time safe
[[nodiscard]] StageTransition transition(const StageVector& z, const WindowStage& from, const WindowStage& to,
                                         const Load& weighed, const EstimatorNoise& noise) noexcept;

/// @return z with slip coefficients within their bounds, and velocities and position within what any platform can have: 20
///         m/s, 50 rad/s, 300 rad/s of the wheels, 100 km. Real-time safe
[[nodiscard]] StageVector contained(const StageVector& z) noexcept;

/// @return a - b, headings the short way round. Real-time safe
[[nodiscard]] StageVector difference(const StageVector& a, const StageVector& b) noexcept;

}  // namespace mrroc::rex
