#include "tasks/rex_drive/plan/proc.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tasks/rex_drive/plan/plan_file.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr double kLongestLeg = 5;      // [m]
constexpr double kLongestDrive = 3.5;  // of a leg [s]: with a ramp it still is a fragment
constexpr double kTurnAtRest = 0.25;   // [rad], from which on a platform at rest turns on the spot first

/// A point of the way, before it has orientations and speeds.
struct Corner {
  double x{}, y{};
  std::int32_t index{};
};

double distance(const Corner& a, const Corner& b) { return std::hypot(b.x - a.x, b.y - a.y); }

/// @return `angle` plus whole turns, as near to `other` as possible
double near(double angle, double other) { return other + wrap_angle(angle - other); }

/// Direction from one point to another one, as near to that heading as possible.
double direction(const Corner& a, const Corner& b, double heading) {
  return near(std::atan2(b.y - a.y, b.x - a.x), heading);
}

/// Where the route begins, and the points of the plan and ahead that are apart, with points between those that are too far
/// apart.
std::vector<Corner> corners_of(const Plan& plan, const PlanarPose& from) {
  std::vector<Corner> corners{{from.x, from.y, -1}};
  const double longest = std::min(kLongestLeg, kLongestDrive * plan.speed);
  for (std::int32_t k = 0; k < plan.n + plan.ahead; ++k) {
    const auto [x, y] = plan.point[static_cast<std::size_t>(k)];
    const Corner last = corners.back(), next{x, y, k};
    const double length = distance(last, next);
    if (length < kSamePoint) continue;
    const int pieces = static_cast<int>(std::ceil(length / longest));
    for (int piece = 1; piece <= pieces; ++piece) {
      const double share = static_cast<double>(piece) / pieces;
      corners.push_back({last.x + share * (x - last.x), last.y + share * (y - last.y), k});
    }
  }
  return corners;
}

PlanPoint standing(const Corner& at, double phi, double cruise) {
  return {.at = {.p = {at.x, at.y, phi}}, .cruise = cruise, .index = std::max(at.index, 0)};
}

/// Adds a turn on the spot, in pieces that each are a fragment.
void add_turn(Route& route, const Corner& at, double from, double to, double turn_rate) {
  constexpr double kLongest = kPlatformPeriod * kMaxFragmentSteps;
  const int pieces = std::max(1, static_cast<int>(std::ceil(time_of_turn(to - from, turn_rate) / kLongest)));
  for (int piece = 1; piece < pieces; ++piece)
    route.push_back(standing(at, std::lerp(from, to, static_cast<double>(piece) / pieces), 0));
  route.push_back(standing(at, to, 0));
}

/// The points with their orientations; `passed` marks those that need no rest. The first point is where the route begins.
Route orient(const std::vector<Corner>& corners, const PathPoint& from, double speed, double turn_rate,
             std::vector<bool>& passed) {
  Route route{{.at = from}};
  passed = {true};
  const auto add = [&](const PlanPoint& point, bool pass) {
    route.push_back(point);
    passed.push_back(pass);
  };
  const auto turn = [&](const Corner& at, double before, double after) {
    add_turn(route, at, before, after, turn_rate);
    passed.resize(route.size(), false);
  };
  double leg = direction(corners[0], corners[1], from.p.phi);
  if (std::abs(leg - from.p.phi) > (from.v == 0 ? kTurnAtRest : kPivotAngle))
    turn(corners[0], from.p.phi, leg);
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    const double next = direction(corners[k], corners[k + 1], leg);
    if (std::abs(next - leg) > kPivotAngle) {
      add(standing(corners[k], leg, speed), false);
      turn(corners[k], leg, next);
    } else {
      add(standing(corners[k], direction(corners[k - 1], corners[k + 1], leg), speed), true);
    }
    leg = next;
  }
  add(standing(corners.back(), leg, speed), true);
  return route;
}

double length_of(const PlanPoint& a, const PlanPoint& b) {
  return std::hypot(b.at.p.x - a.at.p.x, b.at.p.y - a.at.p.y);
}

/// Turns the orientations at points that are passed until the curvature of the way is the same on both sides of each, as
/// that of a cubic spline is: with the chords' directions the platform would swing on every leg of a curve that becomes
/// narrower or wider. The system of equations has one solution, which these sweeps come to within 1e-9 of.
void smooth(Route& route, const std::vector<bool>& passed) {
  constexpr int kSweeps = 20;
  std::vector<double> chord(route.size());  // direction of the leg that ends at the point
  for (std::size_t k = 1; k < route.size(); ++k) {
    const PlanarPose &a = route[k - 1].at.p, &b = route[k].at.p;
    chord[k] = near(std::atan2(b.y - a.y, b.x - a.x), a.phi);
  }
  for (int sweep = 0; sweep < kSweeps; ++sweep)
    for (std::size_t k = 1; k + 1 < route.size(); ++k) {
      if (!passed[k]) continue;
      const double before = 1 / length_of(route[k - 1], route[k]),
                   after = 1 / length_of(route[k], route[k + 1]);
      route[k].at.p.phi = (before * (3 * chord[k] - route[k - 1].at.p.phi) +
                           after * (3 * chord[k + 1] - route[k + 1].at.p.phi)) /
                          (2 * (before + after));
    }
}

/// Curvatures of the way at both ends of a leg, from the angles between its chord and the headings there: those of the
/// cubic curve, exact for arcs that are not long. [1/m]
struct Curvatures {
  double begin{}, end{}, largest{};
};
Curvatures curvatures_of(const PlanPoint& a, const PlanPoint& b) {
  if (b.cruise == 0) return {};
  const double dx = b.at.p.x - a.at.p.x, dy = b.at.p.y - a.at.p.y, length = length_of(a, b);
  const double chord = near(std::atan2(dy, dx), a.at.p.phi);
  const double alpha = a.at.p.phi - chord, beta = b.at.p.phi - chord;
  const double begin = -(4 * alpha + 2 * beta) / length, end = (2 * alpha + 4 * beta) / length;
  return {begin, end, std::max(std::abs(begin), std::abs(end))};
}

/// The largest speed on a curve.
double speed_on(double curvature, double wanted, const RouteLimits& limits) {
  const double kappa = std::abs(curvature);
  if (kappa < 1e-6) return wanted;
  return std::min({wanted, std::sqrt(limits.lateral / kappa), limits.turn_rate / kappa});
}

/// Speeds at the points: as fast as the curves at both sides allow, and as the legs are long enough for.
void set_speeds(Route& route, const std::vector<bool>& passed, const RouteLimits& limits) {
  const std::size_t last = route.size() - 1;
  std::vector<Curvatures> leg(route.size());  // that ends at the point
  for (std::size_t k = 1; k <= last; ++k) {
    leg[k] = curvatures_of(route[k - 1], route[k]);
    if (route[k].cruise > 0) route[k].cruise = speed_on(leg[k].largest, route[k].cruise, limits);
  }
  const auto way = [&](std::size_t k) { return length_of(route[k - 1], route[k]); };
  for (std::size_t k = 1; k <= last; ++k) {
    const bool rests = !passed[k] || k == last;
    const double next = rests ? 0 : route[k + 1].cruise;
    const double before = route[k - 1].at.v;
    route[k].at.v = rests ? 0
                          : std::min({route[k].cruise, next,
                                      std::sqrt(before * before + 2 * limits.acceleration * way(k))});
  }
  for (std::size_t k = last; k > 1; --k) {
    const double after = route[k].at.v;
    double& v = route[k - 1].at.v;
    v = std::min(v, std::sqrt(after * after + 2 * limits.acceleration * way(k)));
    if (passed[k - 1]) route[k - 1].at.w = v * (leg[k - 1].end + leg[k].begin) / 2;
  }
}

}  // namespace

double time_of_turn(double angle, double turn_rate) {
  constexpr double kPeak = 1.875;  // of the turn rate to its mean
  return kPeak * std::abs(angle) / turn_rate;
}

Route proc(const Plan& desired_plan, const PathPoint& from, const RouteLimits& limits) {
  const std::vector<Corner> corners = corners_of(desired_plan, from.p);
  if (corners.size() < 2) return {};
  std::vector<bool> passed;
  Route route = orient(corners, from, desired_plan.speed, limits.turn_rate, passed);
  smooth(route, passed);
  set_speeds(route, passed, limits);
  route.erase(route.begin());
  const auto is_ahead = [&](const PlanPoint& point) { return point.index >= desired_plan.n; };
  route.erase(std::ranges::find_if(route, is_ahead), route.end());
  return route;
}

}  // namespace mrroc::rex_drive
