// Estimates the object's motion, for the velocity feed-forward.
#pragma once
#include <cstdint>

#include "base/camera.hpp"
#include "base/pose.hpp"

namespace mrroc::visual_servo {

/// The object's pose with its uncertainty, as one picture tells it.
struct Sighting {
  std::int64_t step{};  ///< of the effector drivers at which the picture was taken
  Pose T_0G;            ///< object G in the arm's base
  Matrix6 covariance;   ///< of x y z [m], ax ay az [rad] about the origin of G, along the base
};

/// Parameters of the object's assumed motion.
struct TrackParameters {
  double acceleration{0.1};          ///< standard deviation, along each axis [m/s^2]
  double angular_acceleration{0.3};  ///< about each axis [rad/s^2]
  double speed{0.2};                 ///< of an object seen for the first time [m/s]
  double angular_speed{0.5};         ///< the same [rad/s]
  double significance{4};            ///< standard deviations below which a velocity counts as none
  double jump{0.05};                 ///< an object that is so far from where it was expected is a new one [m]
  double angular_jump{0.5};          ///< the same [rad]
  std::int64_t memory{250};          ///< steps without a picture after which the object is a new one
};

/// A Kalman filter for a body with constant velocity and random accelerations, one picture at a time. Poses are
/// deviations from the estimate, along the base. A value: it is part of the memory c_c.
struct ObjectTrack {
  using Covariance = Eigen::Matrix<double, 12, 12>;  ///< of two poses' components: deviation and velocity

  bool known{};                       ///< false: it has not been seen yet, and the rest means nothing
  std::int64_t step{};                ///< of the estimate
  Pose T_0G;                          ///< object G in the arm's base
  Vector3 v{Vector3::Zero()};         ///< of the origin of G, along the base [m/s]
  Vector3 omega{Vector3::Zero()};     ///< along the base [rad/s]
  Covariance P = Covariance::Zero();  ///< x y z, ax ay az, v, omega
};

/// Takes a picture into the estimate. One that is older than the estimate changes nothing. Pure and real-time safe.
[[nodiscard]] ObjectTrack see(const TrackParameters& k, const ObjectTrack& track, const Sighting& seen,
                              double dt);

/// Velocity of the object for the feed-forward.
struct ObjectMotion {
  Vector3 v{Vector3::Zero()};      ///< of the origin of G, along the base [m/s]
  Vector3 omega{Vector3::Zero()};  ///< along the base [rad/s]
};

/// @return the estimated velocity, shrunk towards zero by what its uncertainty could account for: exactly zero for an
///         object that seems to be at rest, so that noise does not become motion of the arm
[[nodiscard]] ObjectMotion significant_motion(const TrackParameters& k, const ObjectTrack& track);

/// @return where an object is after a time [s], negative: was before
[[nodiscard]] Pose carried(const Pose& T_0G, const ObjectMotion& motion, double time);

}  // namespace mrroc::visual_servo
