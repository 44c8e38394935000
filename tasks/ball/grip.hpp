// Statics of an object between two palms.
#pragma once

namespace mrroc::ball {

inline constexpr double kGravity = 9.81;  ///< [m/s^2]

/// @return inner force with which the friction of both palms bears the weight, margin times [N]
[[nodiscard]] constexpr double needed_force(double mass, double friction, double margin) {
  return margin * mass * kGravity / (2 * friction);
}
/// @return weight that the friction of both palms bears, by the margin more than once [N]
[[nodiscard]] constexpr double most_load(double force, double friction, double margin) {
  return 2 * friction * force / margin;
}

}  // namespace mrroc::ball
