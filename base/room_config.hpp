// The room in which platforms drive, as everybody reads it: the simulation that builds its walls, and agents that plan
// ways through it.
//
//   [room]
//   walls = [-3, -2, 3, 2]              # lower and upper corner
//   furniture = true                    # with the obstacles of the built-in room
//   [room.obstacles.crate]
//   box = [1.5, 0.5, 0.4, 0.3, 0.2]     # centre, length, width, angle
//   [room.obstacles.corner]
//   polygon = [1, 1, 2, 1, 1, 2]        # corners, convex
#pragma once
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "base/config.hpp"

namespace mrroc {

/// Place on the map M: x, y [m].
using RoomPoint = std::array<double, 2>;

/// Something that stands in the room.
struct Obstacle {
  std::string name;               ///< of its table
  std::vector<RoomPoint> corner;  ///< of a convex polygon, counter-clockwise, at least 3 [m]
};

/// A rectangular room with obstacles.
struct Room {
  RoomPoint lower{-3, -2};          ///< corner of the walls [m]
  RoomPoint upper{3, 2};            ///< the opposite corner [m]
  std::vector<Obstacle> obstacles;  ///< at most kMostObstacles
};

/// Obstacles of a room.
inline constexpr std::size_t kMostObstacles = 64;
/// Corners of one obstacle.
inline constexpr std::size_t kMostCorners = 32;

/// @return the usual room: nothing stands where a platform that reaches 0.55 m from its middle and keeps within |x| <= 2.2 m,
///         |y| <= 1.4 m could touch it
[[nodiscard]] Room built_in_room();

/// @return [room]; what is not given is as in the built-in one
/// @throws ConfigError; FaultError bad_configuration: walls without a room between them, an obstacle that is neither a box
///         nor a convex polygon, too many
[[nodiscard]] Room read_room(const Config& config);

/// @param from, to  ends of a straight way; equal ends are one place
/// @return least distance between the way and all walls and obstacles [m]; 0 when it touches an obstacle, negative when it
///         leads out of the room
[[nodiscard]] double clearance(const Room& room, const RoomPoint& from, const RoomPoint& to);

/// @param reach  distance from walls and obstacles that is needed [m]
/// @return what is wrong with the way, and of what, such as "in the obstacle 'bench'", "0.30 m from a wall, 0.55 m are
///         needed"; empty: nothing
[[nodiscard]] std::string obstruction(const Room& room, const RoomPoint& from, const RoomPoint& to,
                                      double reach);

}  // namespace mrroc
