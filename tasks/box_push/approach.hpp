// How two platforms come behind a box, one after the other.
#pragma once
#include <array>
#include <optional>

#include "tasks/box_push/detour.hpp"
#include "tasks/box_push/pushes.hpp"

namespace mrroc::box_push {

/// The ways of both platforms to their places before a push.
struct Approach {
  Push push{};                            ///< for which they come there
  PlanarPose pair{};                      ///< of both when they are there, on M
  std::array<Place, kPlatforms> place{};  ///< of each platform in the pair
  std::size_t first{};                    ///< platform that drives first; then the other one does
  std::array<std::vector<Fragment>, kPlatforms> way{};  ///< of each platform
};

/// @param box  where it stands @param platforms  where they stand
/// @return the shortest of all: who drives first, and who is where; nothing: they cannot come there
[[nodiscard]] std::optional<Approach> plan_approach(const Hall& hall, const Push& push, const PlanarPose& box,
                                                    const std::array<PlanarPose, kPlatforms>& platforms,
                                                    const DriveLimits& k);

}  // namespace mrroc::box_push
