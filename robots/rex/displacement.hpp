// What an estimator of Rex does when the map says that the platform is elsewhere: it moves all that it believes, as a whole.
#pragma once
#include <optional>

#include "base/planar.hpp"
#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// A position that comes back after a drop-out corrects the pose alone: how the platform moves is known as before. Taken as a
/// measurement among others, it would be explained by a motion, as a least-squares fit does that finds 20 cm within its 0.4 s.
/// While positions come, it is the other way round: what they contradict is how the platform was believed to move.
/// @param k  stage with a map pose  @param z  what is believed of it
/// @return the motion of the plane that takes the believed pose to that of the map, when it is further away than an estimate
///         wanders: 15 mm or 15 mrad, when no other stage has a map pose; 40 mm or 60 mrad, when none within 0.16 s before has
///         one, and none after it: so it is where the map itself jumps, as the map agent believes a position that contradicts the
///         estimate only after others that agree with it. Nothing while positions come. Real-time safe
[[nodiscard]] std::optional<PlanarPose> displacement_at(const StageWindow& window, int k,
                                                        const StageVector& z) noexcept;

/// @param displacement  of the plane: p becomes chained(displacement, p)
/// @return the state with its pose and its clone moved along; velocities are along the body, and stay. Real-time safe
[[nodiscard]] StageVector moved(StageVector z, const PlanarPose& displacement) noexcept;

/// @return the belief with its mean moved and its covariance turned along. Real-time safe
[[nodiscard]] StageBelief moved(StageBelief belief, const PlanarPose& displacement) noexcept;

}  // namespace mrroc::rex
