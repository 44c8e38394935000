#include "tasks/box_push/detour.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/planar.hpp"

namespace mrroc::box_push {
namespace {

RoomPoint operator-(const RoomPoint& a, const RoomPoint& b) { return {a[0] - b[0], a[1] - b[1]}; }
double length(const RoomPoint& a) { return std::hypot(a[0], a[1]); }

/// Outward normal of the side from a to b of a counter-clockwise polygon.
RoomPoint normal(const RoomPoint& a, const RoomPoint& b) {
  const RoomPoint way = b - a;
  const double l = length(way);
  return {way[1] / l, -way[0] / l};
}

/// Places beside the corners of an obstacle: around each corner at a distance that is a little more than the reach, so that a
/// leg between two of them keeps it.
void add_corners(const Obstacle& obstacle, double reach, std::vector<RoomPoint>& places) {
  constexpr double kBeyond = 0.10;  // [m]
  const auto& c = obstacle.corner;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const RoomPoint &before = c[(k + c.size() - 1) % c.size()], &at = c[k], &after = c[(k + 1) % c.size()];
    const RoomPoint one = normal(before, at), other = normal(at, after);
    const RoomPoint sum{one[0] + other[0], one[1] + other[1]};
    const double l = length(sum);
    if (l < 1e-6) continue;
    const double share = (reach + kBeyond) / l;
    places.push_back({at[0] + share * sum[0], at[1] + share * sum[1]});
    // The same distance from both sides, where a leg runs along one of them.
    const double both = 2 * (reach + kBeyond) / (l * l);
    places.push_back({at[0] + both * sum[0], at[1] + both * sum[1]});
  }
}

/// Shortest ways from the first place to all others (Dijkstra).
struct Reached {
  double length{std::numeric_limits<double>::infinity()};
  std::size_t from{};
  bool done{};
};

}  // namespace

std::optional<Way> way_around(const Room& room, const RoomPoint& from, const RoomPoint& to, double reach) {
  std::vector<RoomPoint> places{from, to};
  for (const Obstacle& each : room.obstacles) add_corners(each, reach, places);
  std::vector<Reached> reached(places.size());
  reached[0].length = 0;
  for (std::size_t n = 0; n < places.size(); ++n) {
    std::size_t nearest = places.size();
    for (std::size_t k = 0; k < places.size(); ++k)
      if (!reached[k].done && (nearest == places.size() || reached[k].length < reached[nearest].length))
        nearest = k;
    if (nearest == 1 || !std::isfinite(reached[nearest].length)) break;
    reached[nearest].done = true;
    for (std::size_t k = 0; k < places.size(); ++k) {
      const double there = reached[nearest].length + length(places[k] - places[nearest]);
      if (reached[k].done || there >= reached[k].length) continue;
      if (clearance(room, places[nearest], places[k]) < reach) continue;
      reached[k] = {there, nearest};
    }
  }
  if (!std::isfinite(reached[1].length)) return std::nullopt;
  Way way{{to}, reached[1].length};
  for (std::size_t k = 1; k != 0; k = reached[k].from) way.points.push_back(places[reached[k].from]);
  std::ranges::reverse(way.points);
  return way;
}

Obstacle rectangle(const PlanarPose& middle, double length, double width) {
  Obstacle o;
  for (const auto& [x, y] : {RoomPoint{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    const PlanarPose p = chained(middle, {x * length / 2, y * width / 2, 0});
    o.corner.push_back({p.x, p.y});
  }
  return o;
}

std::vector<Fragment> drive_along(const Way& way, const PlanarPose& from, double heading,
                                  const DriveLimits& k) {
  std::vector<Fragment> all;
  PlanarPose at = from;
  const auto add = [&](std::vector<Fragment> more) { std::ranges::move(more, std::back_inserter(all)); };
  const auto turn_to = [&](double direction) {
    const double angle = wrap_angle(direction - at.phi);
    add(turn(at, angle, k));
    at.phi += angle;
  };
  for (std::size_t n = 1; n < way.points.size(); ++n) {
    const RoomPoint leg = way.points[n] - RoomPoint{at.x, at.y};
    const double l = length(leg);
    if (l < 1e-3) continue;
    turn_to(std::atan2(leg[1], leg[0]));
    add(straight(at, l, k));
    at = {way.points[n][0], way.points[n][1], at.phi};
  }
  turn_to(heading);
  return all;
}

}  // namespace mrroc::box_push
