#include "base/room_plot.hpp"

#include <fmt/format.h>

namespace mrroc {

std::string plot_rectangle(const RoomPoint& lower, const RoomPoint& upper, const std::string& style) {
  return fmt::format("set object rectangle from {},{} to {},{} {} behind\n", lower[0], lower[1], upper[0],
                     upper[1], style);
}

std::string plot_room(const Room& room) {
  constexpr double kAround = 0.1;  // [m]
  std::string s = fmt::format("set xrange [{}:{}]\nset yrange [{}:{}]\n", room.lower[0] - kAround,
                              room.upper[0] + kAround, room.lower[1] - kAround, room.upper[1] + kAround);
  s += plot_rectangle(room.lower, room.upper,
                      fmt::format("fillstyle empty border lc rgb '{}' lw 2", kWallColour));
  for (const Obstacle& obstacle : room.obstacles) {
    std::string corners;
    for (const auto& [px, py] : obstacle.corner) corners += fmt::format("{},{} to ", px, py);
    const auto& [px, py] = obstacle.corner.front();
    s += fmt::format("set object polygon from {}{},{} fillcolor rgb '{}' fillstyle solid 1 noborder behind\n",
                     corners, px, py, kObstacleColour);
  }
  return s;
}

}  // namespace mrroc
