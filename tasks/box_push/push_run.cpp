#include "tasks/box_push/push_run.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::box_push {
namespace {

/// Duration of a stretch [iterations].
constexpr int kSteps = 25;
/// Way of the pair behind the place where it touches the box, after which both platforms push [m].
constexpr double kUntilBothPush = 0.03;
/// Way by which platforms that push lag behind what they are told [m].
constexpr double kLag = 0.015;

double seconds(double iterations) { return iterations * kPlatformPeriod; }

/// @return way of the pair from its beginning to a place, along its first heading [m]
double way_to(const PushRun& run, const PlanarPose& p) { return seen_from(run.begin, p).x; }

Stretch from_end(const PushRun& run) {
  const PathPoint end = end_of(run);
  Stretch s;
  s.from = end.p;
  s.speed = s.end_speed = end.v;
  s.curvature = s.end_curvature = run.stretches.empty() ? 0 : run.stretches.back().end_curvature;
  s.steps = kSteps;
  return s;
}

/// @return a stretch at whose end the pair stands, after that way or as soon as it can
Stretch to_rest(Stretch s, double way) {
  constexpr int kShortest = 10, kLongest = 100;
  const double time = 2 * std::max(way, 0.0) / s.speed;
  s.steps = std::clamp(static_cast<int>(std::lround(time / kPlatformPeriod)), kShortest, kLongest);
  s.end_speed = 0;
  return s;
}

/// @return a speed that can be reached in a stretch
double reachable(double wanted, double speed, const PushSpeeds& k) {
  const double most = k.acceleration * seconds(kSteps);
  return std::clamp(wanted, speed - most, speed + most);
}

}  // namespace

PushRun begin_push(const Push& push, const PlanarPose& pair, const Formation& f) {
  return {.push = push, .begin = pair, .box = inverse(pair_at(f, push.side, -kLag))};
}

PathPoint end_of(const PushRun& run) {
  if (run.stretches.empty()) return {run.begin};
  return point_of(run.stretches.back(), 1);
}

PlanarPose told_before_end(const PushRun& run, double iterations) {
  double left = std::max(0.0, iterations);
  for (std::size_t k = run.stretches.size(); k > 0; --k) {
    const Stretch& s = run.stretches[k - 1];
    if (left <= s.steps) return point_of(s, 1 - left / s.steps).p;
    left -= s.steps;
  }
  return run.begin;
}

PushRun with_reading(const PushRun& run, const PlanarPose& box, double iterations, const Formation& f) {
  // The side of the box lies flat against both noses: it turns with the pair. What it lags behind on a curve comes after on the
  // straight way, so nothing is learned of its heading.
  constexpr double kShare = 0.2;     // of a reading
  constexpr double kOutlier = 0.25;  // [m], a box does not jump
  const PlanarPose told = told_before_end(run, iterations);
  if (way_to(run, told) < f.gap + kUntilBothPush) return run;
  const PlanarPose seen = seen_from(told, box);
  PushRun next = run;
  const double touching = inverse(pair_at(f, run.push.side, 0)).x;
  next.lag = touching - seen.x;
  next.behind = next.lag > kMostLag ? run.behind + 1 : 0;
  if (std::hypot(seen.x - run.box.x, seen.y - run.box.y) > kOutlier) return next;
  next.box.x += kShare * (seen.x - run.box.x);
  next.box.y += kShare * (seen.y - run.box.y);
  return next;
}

bool stays_behind(const PushRun& run) {
  constexpr int kReadings = 3;
  return run.behind >= kReadings;
}

PlanarPose left_of(const PushRun& run) {
  return seen_from(end_of(run).p, chained(run.push.to, inverse(run.box)));
}

PushRun with_next_stretch(const PushRun& run, const Hall& hall, const PushSpeeds& k) {
  constexpr double kStops = 1;  // [s]
  PushRun next = run;
  Stretch s = from_end(run);
  const Course course = course_to(left_of(run), hall.steering);
  if (way_to(run, s.from) < hall.formation.gap + kUntilBothPush) {
    s.end_speed = k.closing;
  } else if (s.speed > 0 && course.length <= s.speed * kStops / 2) {
    s = to_rest(s, course.length);
  } else {
    s.end_speed = reachable(std::clamp(k.slowing * course.length, k.least, k.pushing), s.speed, k);
    s.end_curvature = course.curvature;
  }
  next.stretches.push_back(s);
  return next;
}

}  // namespace mrroc::box_push
