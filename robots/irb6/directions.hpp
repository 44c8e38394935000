// The directions of an arm's links.
#pragma once
#include <cmath>

namespace mrroc::irb6 {

/// Cosine and sine of an angle.
struct Direction {
  /// Cosine, sine.
  double c, s;
  /// Real-time safe. @param angle [rad]
  [[nodiscard]] static Direction of(double angle) noexcept { return {std::cos(angle), std::sin(angle)}; }
};

/// Links that gravity turns, by their absolute angles (Kinematics) without the angles: the linkages give cosines, and
/// weights and poses need no more.
struct Pitches {
  Direction theta2, theta3, theta4, q5;  ///< lower arm, upper arm, wrist body, wrist
};

/// All links of an arm.
struct Directions : Pitches {
  Direction theta1, q6;  ///< column, flange
  double track;          ///< [m], 0 without a track
};

}  // namespace mrroc::irb6
