// Paths of a mobile platform: points of a reference, and the fragments in which a control subsystem hands a
// trajectory to its effector driver (paper REX, algorithms 6 and 7).
#pragma once
#include <array>
#include <cstdint>

namespace mrroc {

/// Pose of a platform: frame B (x forward, y left, middle between the wheels) on the map M. Trivially copyable.
struct PlanarPose {
  double x{};    ///< [m]
  double y{};    ///< [m]
  double phi{};  ///< heading [rad]; of a path it is unwrapped
};

/// Velocity of a platform, along B. Trivially copyable.
struct PlanarVelocity {
  double vx{};  ///< forward [m/s]
  double vy{};  ///< to the left [m/s]
  double w{};   ///< turn about z [rad/s]
};

/// One point of a reference: where B is to be and how fast. Trivially copyable.
struct PathPoint {
  PlanarPose p;  ///< on the map; phi unwrapped
  double v{};    ///< forward speed [m/s]
  double w{};    ///< [rad/s]
};

/// Knots of a fragment, evenly spaced in time.
inline constexpr std::size_t kFragmentKnots = 33;
/// Duration of an iteration of a platform's virtual effector, that is of its macrostep [s].
inline constexpr double kPlatformPeriod = 0.02;
/// Effector driver steps of such an iteration.
inline constexpr int kPlatformSteps = 10;
/// Longest fragment [iterations].
inline constexpr int kMaxFragmentSteps = 320;

/// A piece of trajectory that lasts `steps` iterations (REX: e_y[traj], [steps], [notify]). Trivially copyable.
struct Fragment {
  std::int64_t number{};  ///< 1, 2, 3...; 0: there is none
  std::int32_t steps{};   ///< duration [iterations of kPlatformPeriod], 1..kMaxFragmentSteps
  /// Iteration after which the driver is ready for the next one, -kMaxFragmentSteps <= notify < steps. A negative one lies
  /// before the fragment's beginning: where fragments are short, several are handed over ahead.
  std::int32_t notify{};
  std::array<PathPoint, kFragmentKnots> knot{};  ///< from the beginning to the end
};

/// @param s  0 at the beginning to 1 at the end; what is outside is taken as the nearer end
/// @return the point of the fragment there, between the knots by cubic Hermite polynomials of x, y and phi, whose slopes
///         are the knots' speeds; v and w are interpolated linearly. Real-time safe.
[[nodiscard]] PathPoint point_at(const Fragment& fragment, double s) noexcept;

/// @return an angle of the same direction within (-pi, pi]; NaN of what is not finite. Real-time safe.
[[nodiscard]] double wrap_angle(double angle) noexcept;

}  // namespace mrroc
