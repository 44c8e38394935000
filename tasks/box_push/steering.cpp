#include "tasks/box_push/steering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::box_push {
namespace {

/// An angle within [0, 2 pi), where nearly a whole turn is none.
double positive(double angle) {
  constexpr double kWhole = 2 * std::numbers::pi, kRounding = 1e-3;
  const double a = std::fmod(std::fmod(angle, kWhole) + kWhole, kWhole);
  return a > kWhole - kRounding ? 0 : a;
}

/// A way of an arc, a straight line and an arc, in radii.
struct ArcWay {
  double first{}, line{}, last{};    // lengths, not negative
  double first_turn{}, last_turn{};  // 1: to the left, -1: to the right
  [[nodiscard]] double length() const { return first + line + last; }
};

/// Dubins' ways to the target: turns to the same side, or to both. @param d  distance @param a, b  headings at the ends from
/// the line to the target
std::optional<ArcWay> arc_way(double d, double a, double b, double first, double last) {
  // Ways to the right are those to the left in a mirror.
  if (first < 0) {
    std::optional<ArcWay> mirrored = arc_way(d, -a, -b, 1, -last);
    if (mirrored) mirrored->first_turn = first, mirrored->last_turn = last;
    return mirrored;
  }
  const double side = last > 0 ? 1 : -1;
  const double along = d + std::sin(a) - side * std::sin(b);
  const double across = side * std::cos(b) - std::cos(a);
  const double square = along * along + across * across - (side > 0 ? 0 : 4);
  if (square < 0) return std::nullopt;
  ArcWay way{.line = std::sqrt(square), .first_turn = first, .last_turn = last};
  const double heading = std::atan2(across, along) + (side > 0 ? 0 : std::atan2(2, way.line));
  way.first = positive(heading - a);
  way.last = positive(side * (b - heading));
  return way;
}

std::optional<ArcWay> shortest_arc_way(const PlanarPose& target, double radius) {
  const double d = std::hypot(target.x, target.y) / radius, direction = std::atan2(target.y, target.x);
  std::optional<ArcWay> best;
  for (const double first : {1.0, -1.0})
    for (const double last : {1.0, -1.0}) {
      const auto way = arc_way(d, -direction, target.phi - direction, first, last);
      if (way && (!best || way->length() < best->length())) best = way;
    }
  return best;
}

/// @return turn with which the way begins: an arc that is hardly one does not count
double turn_of(const ArcWay& way, double radius) {
  constexpr double kHardly = 0.01;  // [m]
  if (way.first * radius > kHardly) return way.first_turn;
  return way.line * radius > kHardly ? 0 : way.last_turn;
}

std::optional<Course> along_arcs(const PlanarPose& target, double radius) {
  constexpr double kDetour = 1.7;  // of the distance: a way that is longer goes around
  const auto way = shortest_arc_way(target, radius);
  if (!way || way->length() * radius > kDetour * std::hypot(target.x, target.y)) return std::nullopt;
  return Course{turn_of(*way, radius) / radius, way->length() * radius};
}

/// Last part of a way [m]: straight on, with what a curve has left of the heading put right.
constexpr double kRunIn = 0.3;

/// A way of arcs that ends before the target, and goes straight on from there.
std::optional<Course> with_run_in(const PlanarPose& target, double radius) {
  constexpr double kPassed = 0.05;  // [m]
  const PlanarPose begin = chained(target, {-kRunIn, 0, 0});
  if (begin.x < kPassed) return std::nullopt;
  std::optional<Course> course = along_arcs(begin, radius);
  if (course) course->length += kRunIn;
  return course;
}

/// The heading of the target is reached. To come to a place aside takes two curves, of which the last part would see one only.
Course straight_in(const PlanarPose& target, const SteeringLimits& k) {
  const double most = 1 / k.least_radius;
  return {std::clamp(target.phi / std::max(target.x, k.nearest), -most, most), target.x};
}

/// Where nothing leads to the target: to a place that is less far aside, as far as that can be reached.
Course course_near(const PlanarPose& target, const SteeringLimits& k) {
  for (const double share : {0.8, 0.6, 0.4, 0.2, 0.0})
    if (const auto course = along_arcs({target.x, share * target.y, target.phi}, k.least_radius))
      return {course->curvature, target.x};
  return straight_in(target, k);
}

}  // namespace

std::optional<Course> planned_course(const PlanarPose& target, const SteeringLimits& k) {
  return with_run_in(target, k.radius);
}

Course course_to(const PlanarPose& target, const SteeringLimits& k) {
  constexpr double kWidest = 12;      // [m]
  constexpr double kNarrower = 0.94;  // from one radius to the next
  const auto widest = [&](const auto& course_of) {
    for (double radius = kWidest; radius > k.least_radius; radius *= kNarrower)
      if (const auto course = course_of(target, radius)) return course;
    return course_of(target, k.least_radius);
  };
  if (target.x < kRunIn) return straight_in(target, k);
  if (const auto course = widest(with_run_in)) return *course;
  if (const auto course = widest(along_arcs)) return *course;
  return course_near(target, k);
}

}  // namespace mrroc::box_push
