// Ways of a platform around what stands in the room.
#pragma once
#include <optional>
#include <vector>

#include "base/platform_path.hpp"
#include "base/room_config.hpp"
#include "tasks/box_push/stretches.hpp"

namespace mrroc::box_push {

/// A way between two places along straight legs.
struct Way {
  std::vector<RoomPoint> points;  ///< from its beginning to its end, at least two
  double length{};                ///< [m]
};

/// @param reach  distance that it keeps from walls and obstacles [m]
/// @return the shortest way of the corners of obstacles; nothing: there is none
[[nodiscard]] std::optional<Way> way_around(const Room& room, const RoomPoint& from, const RoomPoint& to,
                                            double reach);

/// @return a rectangle as an obstacle @param middle  its pose on M
[[nodiscard]] Obstacle rectangle(const PlanarPose& middle, double length, double width);

/// @return fragments from rest to rest along a way: straight legs, with turns on the spot before, between and behind them
/// @param from  heading at its beginning is that of this pose  @param heading  at its end, direction [rad]
[[nodiscard]] std::vector<Fragment> drive_along(const Way& way, const PlanarPose& from, double heading,
                                                const DriveLimits& k);

}  // namespace mrroc::box_push
