#include "base/room_config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace mrroc {
namespace {

constexpr Bounds kPlace{-100, 100};     // [m]
constexpr double kSmallestRoom = 1;     // between walls [m]
constexpr double kSmallestSide = 1e-3;  // of an obstacle [m]

RoomPoint operator-(const RoomPoint& a, const RoomPoint& b) { return {a[0] - b[0], a[1] - b[1]}; }
double cross(const RoomPoint& a, const RoomPoint& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const RoomPoint& a, const RoomPoint& b) { return a[0] * b[0] + a[1] * b[1]; }
double length(const RoomPoint& a) { return std::hypot(a[0], a[1]); }

/// @return twice the area of the triangle, positive when it is counter-clockwise
double turn(const RoomPoint& a, const RoomPoint& b, const RoomPoint& c) { return cross(b - a, c - a); }

const RoomPoint& next(const std::vector<RoomPoint>& corners, std::size_t k) {
  return corners[(k + 1) % corners.size()];
}

double distance(const RoomPoint& p, const RoomPoint& a, const RoomPoint& b) {
  const RoomPoint way = b - a;
  const double square = dot(way, way);
  const double s = square > 0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0;
  return length(p - RoomPoint{a[0] + s * way[0], a[1] + s * way[1]});
}

bool cross_each_other(const RoomPoint& a, const RoomPoint& b, const RoomPoint& c, const RoomPoint& d) {
  return turn(a, b, c) * turn(a, b, d) < 0 && turn(c, d, a) * turn(c, d, b) < 0;
}

bool within(const std::vector<RoomPoint>& corners, const RoomPoint& p) {
  for (std::size_t k = 0; k < corners.size(); ++k)
    if (turn(corners[k], next(corners, k), p) < 0) return false;
  return true;
}

double distance(const std::vector<RoomPoint>& corners, const RoomPoint& from, const RoomPoint& to) {
  if (within(corners, from) || within(corners, to)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const RoomPoint &a = corners[k], &b = next(corners, k);
    if (cross_each_other(from, to, a, b)) return 0;
    least = std::min({least, distance(from, a, b), distance(to, a, b), distance(a, from, to)});
  }
  return least;
}

/// @return negative outside
double to_walls(const Room& room, const RoomPoint& p) {
  return std::min({p[0] - room.lower[0], p[1] - room.lower[1], room.upper[0] - p[0], room.upper[1] - p[1]});
}

std::vector<RoomPoint> box(double x, double y, double length, double width, double angle) {
  std::vector<RoomPoint> corners;
  const double c = std::cos(angle), s = std::sin(angle);
  for (const auto& [i, j] : {RoomPoint{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const double u = i * length / 2, v = j * width / 2;
    corners.push_back({x + c * u - s * v, y + s * u + c * v});
  }
  return corners;
}

/// @return whether every corner turns to the left, and all of them together once
bool convex(const std::vector<RoomPoint>& corners) {
  double turned = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const RoomPoint one = next(corners, k) - corners[k];
    const RoomPoint other = next(corners, k + 1) - next(corners, k);
    if (length(one) < kSmallestSide || cross(one, other) <= 0) return false;
    turned += std::atan2(cross(one, other), dot(one, other));
  }
  return turned < 7;  // rad; more than once around, and it would cross itself
}

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw FaultError(FaultCode::bad_configuration, key + ": " + text);
}

std::vector<RoomPoint> polygon(const std::string& key, const std::vector<double>& numbers) {
  if (numbers.size() < 6 || numbers.size() > 2 * kMostCorners || numbers.size() % 2 != 0)
    refuse(key, fmt::format("the corners x, y of a polygon are 3 to {} pairs of numbers, not {} numbers",
                            kMostCorners, numbers.size()));
  std::vector<RoomPoint> corners;
  for (std::size_t k = 0; k < numbers.size(); k += 2) corners.push_back({numbers[k], numbers[k + 1]});
  if (turn(corners[0], corners[1], corners[2]) < 0) std::ranges::reverse(corners);
  if (!convex(corners))
    refuse(key, "the polygon is not convex, or some of its corners are on one line; make several of it");
  return corners;
}

/// @param usual  what it is unless the table says it
Obstacle read_obstacle(const Config& config, const std::string& name, const Obstacle* usual) {
  const std::string key = "room.obstacles." + name;
  const Config table = config.section(key);
  std::vector<double> fallback;
  if (usual && !table.has("box"))
    for (const RoomPoint& corner : usual->corner)
      fallback.insert(fallback.end(), corner.begin(), corner.end());
  const auto corners = table.list("polygon", fallback, kPlace, "m, x y of its corners; empty: it is a box");
  if (!corners.empty()) {
    if (table.has("box")) refuse(key, "it is a box or a polygon; leave one of them out");
    return {name, polygon(key + ".polygon", corners)};
  }
  const auto b = table.numbers<5>("box", std::nullopt, kPlace, "m, rad: centre x y, length, width, angle");
  if (b[2] < kSmallestSide || b[3] < kSmallestSide)
    refuse(key + ".box", fmt::format("its length and width must be at least {:g} m", kSmallestSide));
  return {name, box(b[0], b[1], b[2], b[3], b[4])};
}

}  // namespace

Room built_in_room() {
  Room room;
  room.obstacles = {{"bench", {{2.8, -0.5}, {3, -0.5}, {3, 0.5}, {2.8, 0.5}}},
                    {"cabinet", {{2.7, 1.7}, {3, 1.7}, {3, 2}, {2.7, 2}}},
                    {"corner", {{-3, -2}, {-2.6, -2}, {-3, -1.6}}}};
  return room;
}

Room read_room(const Config& config) {
  const Room usual = built_in_room();
  Room room;
  const auto walls = config.numbers<4>(
      "room.walls", std::array{usual.lower[0], usual.lower[1], usual.upper[0], usual.upper[1]}, kPlace,
      "m: x y of the lower corner, x y of the upper one");
  room.lower = {walls[0], walls[1]};
  room.upper = {walls[2], walls[3]};
  if (room.upper[0] - room.lower[0] < kSmallestRoom || room.upper[1] - room.lower[1] < kSmallestRoom)
    refuse("room.walls",
           fmt::format("the upper corner must be at least {:g} m above the lower one, in x and in y",
                       kSmallestRoom));
  std::set<std::string> names;
  for (const std::string& name : config.tables("room.obstacles")) names.insert(name);
  if (config.flag("room.furniture", true))
    for (const Obstacle& each : usual.obstacles) names.insert(each.name);
  if (names.size() > kMostObstacles)
    refuse("room.obstacles", fmt::format("{} are too many, {} may be", names.size(), kMostObstacles));
  for (const std::string& name : names) {
    const auto same = std::ranges::find(usual.obstacles, name, &Obstacle::name);
    room.obstacles.push_back(read_obstacle(config, name, same == usual.obstacles.end() ? nullptr : &*same));
  }
  return room;
}

double clearance(const Room& room, const RoomPoint& from, const RoomPoint& to) {
  double least = std::min(to_walls(room, from), to_walls(room, to));
  for (const Obstacle& obstacle : room.obstacles)
    least = std::min(least, distance(obstacle.corner, from, to));
  return least;
}

std::string obstruction(const Room& room, const RoomPoint& from, const RoomPoint& to, double reach) {
  double least = std::min(to_walls(room, from), to_walls(room, to));
  if (least < 0)
    return fmt::format("outside the room, whose walls are at x {:g} and {:g} m, y {:g} and {:g} m",
                       room.lower[0], room.upper[0], room.lower[1], room.upper[1]);
  std::string nearest = "a wall";
  for (const Obstacle& obstacle : room.obstacles)
    if (const double d = distance(obstacle.corner, from, to); d < least) {
      least = d;
      nearest = fmt::format("the obstacle '{}'", obstacle.name);
    }
  if (least >= reach) return {};
  if (least == 0) return fmt::format("{} {}", from == to ? "in" : "through", nearest);
  return fmt::format("{:.2f} m from {}, {:.2f} m are needed", least, nearest, reach);
}

}  // namespace mrroc
