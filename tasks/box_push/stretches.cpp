#include "tasks/box_push/stretches.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/planar.hpp"

namespace mrroc::box_push {
namespace {

/// Fragments are not longer than that [iterations].
constexpr int kLongest = 300;
/// Motions of the least jerk are so much faster in their middle than in the mean.
constexpr double kPeak = 1.875;
/// Shortest motion from rest to rest [iterations].
constexpr int kShortest = 25;

constexpr std::size_t kLast = kFragmentKnots - 1;

/// Way of the least jerk from 0 to 1, and its derivative. @param s  0..1
double smooth(double s) { return s * s * s * (10 + s * (6 * s - 15)); }
double smooth_rate(double s) { return 30 * s * s * (1 - s) * (1 - s); }

int notify_of(int steps, const DriveLimits& k) { return std::max(steps - k.lead, -kMaxFragmentSteps); }

/// Cuts a motion into fragments. @param steps  of the whole @param at  by the share of its duration
std::vector<Fragment> cut(int steps, const DriveLimits& k, const std::function<PathPoint(double)>& at) {
  std::vector<Fragment> all;
  const int n = (steps + kLongest - 1) / kLongest;
  for (int part = 0; part < n; ++part) {
    const int from = steps * part / n, to = steps * (part + 1) / n;
    Fragment f;
    f.steps = to - from;
    f.notify = notify_of(f.steps, k);
    for (std::size_t knot = 0; knot <= kLast; ++knot) {
      const double share = static_cast<double>(knot) / kLast;
      f.knot[knot] = at((from + share * f.steps) / steps);
    }
    all.push_back(f);
  }
  return all;
}

int steps_of(double way, double most) {
  const double seconds = kPeak * std::abs(way) / most;
  return std::max(kShortest, static_cast<int>(std::ceil(seconds / kPlatformPeriod)));
}

}  // namespace

std::vector<Fragment> straight(const PlanarPose& from, double length, const DriveLimits& k) {
  if (length == 0) return {};
  const int steps = steps_of(length, k.speed);
  return cut(steps, k, [&](double s) {
    return PathPoint{chained(from, {length * smooth(s), 0, 0}),
                     length * smooth_rate(s) / (steps * kPlatformPeriod), 0};
  });
}

std::vector<Fragment> turn(const PlanarPose& from, double angle, const DriveLimits& k) {
  if (angle == 0) return {};
  const int steps = steps_of(angle, k.turn_rate);
  return cut(steps, k, [&](double s) {
    return PathPoint{{from.x, from.y, from.phi + angle * smooth(s)},
                     0,
                     angle * smooth_rate(s) / (steps * kPlatformPeriod)};
  });
}

PathPoint point_of(const Stretch& stretch, double share) {
  constexpr int kPieces = 32;
  const double whole = stretch.steps * kPlatformPeriod, time = share * whole, h = time / kPieces;
  const auto speed = [&](double t) { return std::lerp(stretch.speed, stretch.end_speed, t / whole); };
  const auto curvature = [&](double t) {
    return std::lerp(stretch.curvature, stretch.end_curvature, t / whole);
  };
  PlanarPose p = stretch.from;
  for (int n = 0; n < kPieces; ++n) {
    const double t = (n + 0.5) * h;
    const double way = h * speed(t), angle = way * curvature(t);
    const double middle = p.phi + angle / 2;
    p = {p.x + way * std::cos(middle), p.y + way * std::sin(middle), p.phi + angle};
  }
  return {p, speed(time), speed(time) * curvature(time)};
}

Fragment fragment_of(const Stretch& stretch, double beside, const DriveLimits& k) {
  Fragment f;
  f.steps = stretch.steps;
  f.notify = notify_of(f.steps, k);
  for (std::size_t knot = 0; knot <= kLast; ++knot) {
    const PathPoint pair = point_of(stretch, static_cast<double>(knot) / kLast);
    f.knot[knot] = {chained(pair.p, {0, beside, 0}), pair.v - beside * pair.w, pair.w};
  }
  return f;
}

}  // namespace mrroc::box_push
