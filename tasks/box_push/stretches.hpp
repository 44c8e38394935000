// Fragments of trajectories: straight ways, turns on the spot, and stretches of the pair's way, on which both platforms
// keep their places.
#pragma once
#include <cstdint>
#include <vector>

#include "base/platform_path.hpp"

namespace mrroc::box_push {

/// How fast a platform goes by itself, and when it wants to know how it goes on.
struct DriveLimits {
  double speed{0.5};      ///< most of a straight way [m/s]
  double turn_rate{1.2};  ///< most of a turn on the spot [rad/s]
  int lead{54};           ///< iterations before a fragment's end at which the driver asks for the next one
};

/// @param length  ahead, negative: backwards [m]
/// @return fragments of a straight way from rest to rest; none of no way
[[nodiscard]] std::vector<Fragment> straight(const PlanarPose& from, double length, const DriveLimits& k);
/// @param angle  to the left [rad] @return fragments of a turn on the spot from rest to rest; none of no turn
[[nodiscard]] std::vector<Fragment> turn(const PlanarPose& from, double angle, const DriveLimits& k);

/// A stretch of a way along which speed and curvature change evenly with time.
struct Stretch {
  PlanarPose from;                      ///< where it begins
  double speed{}, end_speed{};          ///< [m/s]
  double curvature{}, end_curvature{};  ///< to the left [1/m]
  std::int32_t steps{};                 ///< duration [iterations], 1..kMaxFragmentSteps
};

/// @param share  of its duration, 0..1 @return where a stretch has led to by then
[[nodiscard]] PathPoint point_of(const Stretch& stretch, double share);
/// @param beside  place of a platform in the pair, to the left of its middle [m]
/// @return the fragment of that platform when the pair drives the stretch; numbers are not set
[[nodiscard]] Fragment fragment_of(const Stretch& stretch, double beside, const DriveLimits& k);

}  // namespace mrroc::box_push
