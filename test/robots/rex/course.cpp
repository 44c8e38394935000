#include "test/robots/rex/course.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "robots/rex/model.hpp"

namespace mrroc::rex::test {
namespace {

using std::numbers::pi;

constexpr double kHorizonPeriod = 0.05;  // [s]

/// A time that begins slowly: its rate grows from 0 to 1 over the first 2 s.
struct Begun {
  double time, rate;
};
Begun begun(double t) {
  constexpr double kRamp = 2;
  return t < kRamp ? Begun{t * t / (2 * kRamp), t / kRamp} : Begun{t - kRamp / 2, 1};
}

/// Smallest jerk from 0 to 1 over a time; value and speed.
struct Blend {
  double s, rate;
};
Blend minimum_jerk(double t, double duration) {
  const double q = std::clamp(t / duration, 0., 1.);
  return {q * q * q * (10 - 15 * q + 6 * q * q), 30 * q * q * (1 - q) * (1 - q) / duration};
}

}  // namespace

Course figure_eight(double lap) {
  const double W = 2 * pi / lap;
  // Turned so that it begins at the origin along x, and unwrapped from there.
  const auto last = std::make_shared<double>(0);
  const auto at = [W, last](double t) {
    const auto [time, rate] = begun(t);
    const double a = W * time;
    const double dx = 2 * W * std::cos(a), dy = 2 * W * std::cos(2 * a);
    const double ddx = -2 * W * W * std::sin(a), ddy = -4 * W * W * std::sin(2 * a);
    const double speed = std::hypot(dx, dy);
    const double c = std::cos(pi / 4), s = -std::sin(pi / 4);
    const double x = 2 * std::sin(a), y = std::sin(2 * a);
    const double direction = std::atan2(dy, dx) - pi / 4;
    *last += wrap_angle(direction - *last);
    return PathPoint{
        {c * x - s * y, s * x + c * y, *last}, rate * speed, rate * (dx * ddy - dy * ddx) / (speed * speed)};
  };
  return {at, lap + 1};
}

Course corner(double v) {
  constexpr double kStraight = 2, kRadius = 0.4;
  constexpr double kArc = kRadius * pi / 2;
  const auto at = [v](double t) {
    const auto [time, rate] = begun(t);
    const double s = std::min(v * time, 2 * kStraight + kArc);
    const double speed = v * time > s ? 0 : v * rate;
    if (s < kStraight) return PathPoint{{s, 0, 0}, speed, 0};
    if (s > kStraight + kArc)
      return PathPoint{{kStraight + kRadius, kRadius + s - kStraight - kArc, pi / 2}, speed, 0};
    const double a = (s - kStraight) / kRadius;
    return PathPoint{
        {kStraight + kRadius * std::sin(a), kRadius * (1 - std::cos(a)), a}, speed, speed / kRadius};
  };
  return {at, (2 * kStraight + kArc) / v + 4};
}

Course pivot() {
  const auto at = [](double t) {
    constexpr double kWay = 1.2;
    const Blend there = minimum_jerk(t, 3), turn = minimum_jerk(t - 3.2, 2.2), on = minimum_jerk(t - 5.6, 3);
    return PathPoint{
        {kWay * there.s, kWay * on.s, pi / 2 * turn.s}, kWay * (there.rate + on.rate), pi / 2 * turn.rate};
  };
  return {at, 10};
}

edp::EstimatorResult perfect(const Plant& plant, const Truth& truth) {
  edp::EstimatorResult x;
  x.estimate = {.p = plant.p(), .v = plant.v(), .theta = plant.theta(), .theta_dot = plant.speed()};
  x.estimate.p.phi = wrap_angle(x.estimate.p.phi);
  x.mass = truth.mass;
  x.centre = {truth.centre_x, truth.centre_y, 0};
  return x;
}

std::array<PathPoint, kHorizonPoints> horizon(const Course& course, double time) {
  std::array<PathPoint, kHorizonPoints> points;
  for (std::size_t k = 0; k < points.size(); ++k)
    points[k] = course.at(time + static_cast<double>(k) * kHorizonPeriod);
  return points;
}

Tracked track(edp::Tracker& tracker, const Course& course, const Loop& loop) {
  Tracked tracked;
  Plant plant(loop.truth);
  const PerWheel load = standing_load(loop.truth.mass, {loop.truth.centre_x, loop.truth.centre_y, 0});
  PerWheel torque{};
  double sum = 0;
  int counted = 0;
  tracker.begin(perfect(plant, loop.truth));
  for (double t = 0; t < course.duration; t += kPlatformPeriod) {
    const PathPoint wanted = course.at(t);
    const double error = std::hypot(plant.p().x - wanted.p.x, plant.p().y - wanted.p.y);
    tracked.last = error;
    if (t > 1) {
      sum += error * error;
      ++counted;
      tracked.max = std::max(tracked.max, error);
    }
    const edp::TrackerResult r =
        tracker.step(perfect(plant, loop.truth), loop.believed, load, horizon(course, t));
    plant.step(torque, loop.delay);
    torque = r.torque;
    plant.step(torque, kPlatformPeriod - loop.delay);
    for (const double each : torque)
      tracked.largest_torque = std::max(tracked.largest_torque, std::abs(each));
    tracked.failures += static_cast<int>(r.health.solver_failed);
    tracked.most_iterations = std::max(tracked.most_iterations, r.health.iterations);
    tracked.results.push_back(r);
  }
  tracked.rms = std::sqrt(sum / counted);
  return tracked;
}

}  // namespace mrroc::rex::test
