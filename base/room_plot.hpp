// A room in a picture, seen from above.
#pragma once
#include <string>
#include <string_view>

#include "base/room_config.hpp"

namespace mrroc {

/// Colours of the lines of walls, and of the areas of obstacles.
inline constexpr std::string_view kWallColour = "#667080";
inline constexpr std::string_view kObstacleColour = "#c3cad4";

/// @param style  of gnuplot's objects @return command that draws a rectangle behind everything
[[nodiscard]] std::string plot_rectangle(const RoomPoint& lower, const RoomPoint& upper,
                                         const std::string& style);
/// @return commands that set the ranges of both axes to the room, and draw its walls and obstacles behind everything
[[nodiscard]] std::string plot_room(const Room& room);

}  // namespace mrroc
