// What an estimator of Rex does when the map says that the platform is elsewhere: it moves all that it believes, as a whole.
#pragma once
#include <Eigen/Core>
#include <optional>

#include "base/planar.hpp"
#include "robots/rex/stage_belief.hpp"

namespace mrroc::rex {

/// A position that comes back after a drop-out corrects the pose alone: how the platform moves is known as before. Taken as a
/// measurement among others, it would be explained by a motion, as a least-squares fit does that finds 20 cm within its 0.4 s.
/// While positions come, it is the other way round: what they contradict is how the platform was believed to move.
struct Displacement {
  PlanarPose motion;   ///< of the plane [m, rad]: p becomes chained(motion, p)
  Eigen::Vector2d at;  ///< where the platform is then, on M [m]
  /// Of the pose of the map there (x, y, phi) [m^2, m rad, rad^2], as far as it displaces.
  Eigen::Matrix3d covariance{Eigen::Matrix3d::Zero()};
};

/// @param k  stage with a map pose  @param z  what is believed of it  @param covariance  of the pose of B that is believed
/// @return what takes the believed pose to that of the map, when it is beyond the ellipse of both (99.9 %), and further away
///         than an estimate wanders: 15 mm or 15 mrad, when no other stage has a map pose; 40 mm or 60 mrad, and beyond twice
///         the ellipse, when none within 0.16 s before has one, and none after it. So it is where the map itself jumps, as the
///         map agent believes a position that contradicts the estimate only after others that agree with it. Nothing while
///         positions come. Real-time safe
[[nodiscard]] std::optional<Displacement> displacement_at(const StageWindow& window, int k,
                                                          const StageVector& z,
                                                          const Eigen::Matrix3d& covariance) noexcept;

/// @param motion  of the plane
/// @return the state with its pose and its clone moved along; velocities are along the body, and stay. Real-time safe
[[nodiscard]] StageVector moved(StageVector z, const PlanarPose& motion) noexcept;

/// @return the belief with its mean moved, and its covariance turned along and larger by that of the map pose: where the
///         platform is now is known from that pose alone. Real-time safe
[[nodiscard]] StageBelief moved(StageBelief belief, const Displacement& displacement) noexcept;

}  // namespace mrroc::rex
