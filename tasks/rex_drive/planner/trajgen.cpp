#include "tasks/rex_drive/planner/trajgen.hpp"

#include <algorithm>
#include <cmath>

#include "tasks/rex_drive/planner/ecsa.hpp"

namespace mrroc::rex_drive {
namespace {

constexpr int kStretches = 4;
constexpr double kStretch = 1.3;
constexpr double kLongestWay = 1.6;  // of the distance
constexpr double kBackwards = 0.02;  // [m/s], which is not driving backwards

constexpr double kLongest = kPlatformPeriod * kMaxFragmentSteps;

/// Whole iterations, not shorter than that.
double whole_iterations(double duration) {
  return kPlatformPeriod * std::max(1.0, std::ceil(duration / kPlatformPeriod - 1e-9));
}

/// Time for a way with speeds that rise and fall evenly.
double time_for(double way, double before, double after, double cruise, double acceleration) {
  const double squares = (before * before + after * after) / 2;
  const double most = std::max({before, after, std::min(cruise, std::sqrt(acceleration * way + squares))});
  const double ramps = (most - before + most - after) / acceleration;
  const double ramped = (most * most - squares) / acceleration;
  return ramps + std::max(0.0, way - ramped) / most;
}

/// Of a circle's arc: it is longer than the chord.
double length_of_way(double distance, double turn) {
  const double half = std::abs(turn) / 2;
  return half < 1e-6 ? distance : distance * half / std::sin(std::min(half, 1.5));
}

/// A turn on the spot with the least jerk: w is a polynomial of fourth degree.
Leg turn_on_the_spot(const PathPoint& from, const PlanPoint& to, const PlannerParameters& k) {
  const double angle = to.at.p.phi - from.p.phi;
  Leg leg{.trajectory = {.index = to.index}};
  Trajectory& t = leg.trajectory;
  t.duration = whole_iterations(time_of_turn(angle, k.route.turn_rate));
  leg.found = std::abs(from.v) < kBackwards && t.duration <= kLongest;
  for (std::size_t n = 0; n < kFragmentKnots; ++n) {
    const double s = static_cast<double>(n) / (kFragmentKnots - 1);
    t.knot[n].p = {from.p.x, from.p.y, from.p.phi + angle * s * s * s * (10 + s * (6 * s - 15))};
    t.knot[n].w = angle / t.duration * 30 * s * s * (1 - s) * (1 - s);
  }
  t.knot.back().p.phi = to.at.p.phi;
  return leg;
}

bool within(const EndPointSolution& s, double distance, const PathLimits& limits) {
  return s.converged && s.length <= kLongestWay * distance && s.least_v >= -kBackwards &&
         s.most_v <= limits.speed && s.most_w <= limits.turn_rate && s.most_vw <= limits.lateral;
}

}  // namespace

Leg plan_leg(const PathPoint& from, const PlanPoint& to, const PlannerParameters& k) {
  if (to.cruise == 0) return turn_on_the_spot(from, to, k);
  const double distance = std::hypot(to.at.p.x - from.p.x, to.at.p.y - from.p.y);
  const double way = length_of_way(distance, to.at.p.phi - from.p.phi);
  EndPointProblem problem{.from = from, .to = to.at};
  double duration = time_for(way, from.v, to.at.v, to.cruise, k.route.acceleration);
  for (int stretch = 0; stretch <= kStretches && duration <= kLongest; ++stretch) {
    problem.duration = whole_iterations(duration);
    const EndPointSolution s = solve(problem);
    if (within(s, distance, k.path))
      return {
          .found = true,
          .trajectory = {
              .knot = s.knot, .duration = problem.duration, .index = to.index, .iterations = s.iterations}};
    duration *= kStretch;
    problem.to.v /= kStretch;
    problem.to.w /= kStretch;
  }
  return {};
}

Trajgen trajgen_init(const Trajgen& trajgen, const PathPoint& state) { return {.k = trajgen.k, .at = state}; }

Trajgen trajgen_start(const Trajgen& trajgen, const PlanPoint& point) {
  const Leg leg = plan_leg(trajgen.at, point, trajgen.k);
  Trajgen next{
      .k = trajgen.k, .at = trajgen.at, .busy = leg.found, .failed = !leg.found, .found = leg.trajectory};
  if (leg.found) next.at = leg.trajectory.knot.back();
  return next;
}

Trajgen trajgen_stop(const Trajgen& trajgen) { return trajgen_init(trajgen, trajgen.at); }

Trajgen trajgen_get_stat(const Trajgen& trajgen) {
  Trajgen next = trajgen;
  if (next.busy) ++next.elapsed;
  return next;
}

bool trajgen_is_ready(const Trajgen& trajgen) {
  return trajgen.busy && trajgen.elapsed >= trajgen.k.planning;
}

const Trajectory& trajgen_get_traj(const Trajgen& trajgen) { return trajgen.found; }

std::int32_t traj_to_steps(const Trajectory& traj) {
  return static_cast<std::int32_t>(std::lround(traj.duration / kPlatformPeriod));
}

std::int32_t traj_to_notify(const Trajectory& traj, double lead) {
  const std::int32_t steps = traj_to_steps(traj);
  return std::min(steps - static_cast<std::int32_t>(std::lround(lead / kPlatformPeriod)), steps - 1);
}

}  // namespace mrroc::rex_drive
