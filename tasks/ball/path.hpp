// Where the object is led: up, around the circle, down. The line between the palms is level.
#pragma once
#include <numbers>

#include "tasks/ball/ball.hpp"

namespace mrroc::ball {

/// The line from the second palm to the first, along which they press, in the world.
inline const Vector3 kLine{0, 1, 0};

/// @return orientation of the tool of an arm in the world: z out of the palm, x up
[[nodiscard]] Matrix3 palm_orientation(std::size_t arm);

/// @param u  0..1, clamped @return 0..1, beginning and ending at rest
[[nodiscard]] double smooth(double u);

/// Macrosteps in which the object is led up or down, and in which it gets its speed around the circle.
inline constexpr double kLiftTime = 150, kSpeedUp = 50;
/// Way down beyond the beginning of the way up, for an object that has slid up between the palms [m].
inline constexpr double kBelow = 0.004;

/// @param age  task time since the behaviour began [macrosteps]; before and after it the object stands
/// @return the way of the object since the palms closed [m]
[[nodiscard]] Vector3 path(const Parameters& k, int m, double age);

/// @return angle around the circle [rad]
[[nodiscard]] double circle_angle(const Parameters& k, double age);
/// @return macrosteps of a behaviour that leads the object
[[nodiscard]] double duration(const Parameters& k, int m);

}  // namespace mrroc::ball
