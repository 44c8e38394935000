#include "tasks/box_push/pushes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

namespace mrroc::box_push {
namespace {

/// Way that driving around the box is worth [m].
constexpr double kAnother = 1.5;

/// A pose of the box, and how it has come there.
struct Node {
  PlanarPose box{};
  Pushes pushes{};
  double cost{};
};

/// @return where the box comes to when the pair drives that arc
PlanarPose pushed(const Hall& hall, Side side, const PlanarPose& box, double curvature, double length) {
  const PlanarPose pair = pair_at(hall.formation, side, 0);
  const double angle = curvature * length;
  const double chord = angle == 0 ? length : 2 * std::sin(angle / 2) / curvature;
  const PlanarPose arc{chord * std::cos(angle / 2), chord * std::sin(angle / 2), angle};
  PlanarPose there = chained(chained(chained(box, pair), arc), inverse(pair));
  there.phi = wrap_angle(there.phi);
  return there;
}

/// Whether a way of the box from one pose to another has room, looked at in its middle and at its ends.
bool way_has_room(const Hall& hall, Side side, const PlanarPose& from, const PlanarPose& to) {
  const PlanarPose middle{(from.x + to.x) / 2, (from.y + to.y) / 2,
                          from.phi + wrap_angle(to.phi - from.phi) / 2};
  return has_room(hall, side, from) && has_room(hall, side, middle) && has_room(hall, side, to);
}

/// @return the node's pushes with a last one to the goal; infinite cost: there is none
Node finished(const Hall& hall, const Node& node, const PlanarPose& goal) {
  Node best{.cost = std::numeric_limits<double>::infinity()};
  for (const Side side : kSides) {
    const PlanarPose pair = pair_at(hall.formation, side, 0);
    const auto course =
        planned_course(seen_from(chained(node.box, pair), chained(goal, pair)), hall.steering);
    if (!course) continue;
    const double cost = node.cost + course->length + kAnother;
    if (cost >= best.cost || !way_has_room(hall, side, node.box, goal)) continue;
    best = {goal, node.pushes, cost};
    best.pushes.push_back({side, goal});
  }
  return best;
}

/// Cells of poses, one of which is enough.
class Visited {
 public:
  /// @return whether no pose of its cell has come before
  bool add(const PlanarPose& p) {
    constexpr double kPlace = 0.2, kAngle = 0.17;  // [m], [rad]
    return cells_.emplace(std::lround(p.x / kPlace), std::lround(p.y / kPlace), std::lround(p.phi / kAngle))
        .second;
  }

 private:
  std::set<std::tuple<long, long, long>> cells_;
};

/// @return the nodes that are one push farther
std::vector<Node> expanded(const Hall& hall, const std::vector<Node>& nodes, Visited& visited) {
  constexpr std::array kLengths{0.4, 0.8, 1.4, 2.2, 3.0};
  constexpr std::array kCurves{0.0, -0.95, 0.95, -0.5, 0.5};  // of the narrowest one
  // What comes between need not be exact: curves may be narrower than those of the last push.
  const double radius = std::lerp(hall.steering.radius, hall.steering.least_radius, 0.7);
  std::vector<Node> next;
  for (const Node& node : nodes)
    for (const Side side : kSides)
      for (const double curve : kCurves)
        for (const double length : kLengths) {
          const PlanarPose to = pushed(hall, side, node.box, curve / radius, length);
          if (!way_has_room(hall, side, node.box, to) || !visited.add(to)) continue;
          next.push_back({to, node.pushes, node.cost + length + kAnother});
          next.back().pushes.push_back({side, to});
        }
  return next;
}

}  // namespace

bool has_room(const Hall& hall, Side side, const PlanarPose& box) {
  const Formation& f = hall.formation;
  const RoomPoint middle{box.x, box.y};
  if (clearance(hall.room, middle, middle) < std::hypot(f.box_length, f.box_width) / 2) return false;
  const PlanarPose pair = chained(box, pair_at(f, side, 0)), away = chained(box, pair_at(f, side, f.retreat));
  return std::ranges::all_of(kPlaces, [&](Place place) {
    const PlanarPose near = chained(pair, member_at(f, place)), far = chained(away, member_at(f, place));
    return clearance(hall.room, {near.x, near.y}, {far.x, far.y}) >= hall.reach;
  });
}

std::optional<Pushes> plan_pushes(const Hall& hall, const PlanarPose& box, const PlanarPose& goal) {
  std::vector<Node> nodes{{.box = box}};
  Visited visited;
  Node best{.cost = std::numeric_limits<double>::infinity()};
  for (int n = 1; n <= kMostPushes; ++n) {
    for (const Node& node : nodes)
      if (Node end = finished(hall, node, goal); end.cost < best.cost) best = std::move(end);
    if (!best.pushes.empty()) return best.pushes;
    if (n < kMostPushes) nodes = expanded(hall, nodes, visited);
  }
  return std::nullopt;
}

}  // namespace mrroc::box_push
