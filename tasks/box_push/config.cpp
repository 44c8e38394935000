#include "tasks/box_push/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc::box_push {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

std::int64_t macrosteps(double seconds) { return std::llround(seconds / kPlatformPeriod); }

Hall read_hall(const Config& config) {
  Hall hall;
  hall.room = read_room(config);
  const Config t = config.section("task");
  Formation& f = hall.formation;
  const auto box = t.numbers<2>("box_size", {{f.box_length, f.box_width}}, {0.2, 3},
                                "m, along x and y of the box; platforms push the sides along y");
  f.box_length = box[0];
  f.box_width = box[1];
  f.gap = t.number("gap", f.gap, {0.03, 0.5}, "m, between platforms and box before a push");
  f.retreat = t.number("retreat", f.retreat, {0.2, 2}, "m, the same where platforms turn on the spot");
  hall.steering.radius =
      t.number("radius", hall.steering.radius, {0.5, 100}, "m, of the curves of a push as they are planned");
  hall.steering.least_radius = t.number("least_radius", hall.steering.least_radius,
                                        {0.5, hall.steering.radius}, "m, of the narrowest one");
  hall.reach = t.number("reach", hall.reach, {0.52, 2}, "m, that a platform needs around its middle");
  return hall;
}

}  // namespace

CoordinatorParameters read_coordinator(const Config& config) {
  // The grid of the platforms' kernels is one of these macrosteps.
  std::ignore = config.number("time.dt", kPlatformPeriod / kPlatformSteps,
                              {kPlatformPeriod / kPlatformSteps, kPlatformPeriod / kPlatformSteps}, "s");
  std::ignore = config.integer("time.n_s", kPlatformSteps, {kPlatformSteps, kPlatformSteps}, "steps");
  const Config t = config.section("task");
  CoordinatorParameters k;
  k.hall = read_hall(config);
  const auto to = t.numbers<3>("to", {{1.9, 0.8, 25}}, {-1000, 1000}, "m, m, degrees: x, y, phi of the box");
  k.goal = {to[0], to[1], wrap_angle(to[2] * kDegree)};
  k.drive.speed = t.number("speed", k.drive.speed, {0.1, 1.4}, "m/s, of a platform by itself");
  k.drive.turn_rate = t.number("turn_rate", k.drive.turn_rate, {0.2, 2.0}, "rad/s, of the same on the spot");
  k.speeds.pushing = t.number("push_speed", k.speeds.pushing, {0.04, 0.4}, "m/s, of a push");
  k.tolerance.position =
      t.number("tolerance", k.tolerance.position, {0.005, 1}, "m, of the box at its goal, as it is seen");
  k.tolerance.heading =
      kDegree * t.number("tolerance_deg", k.tolerance.heading / kDegree, {0.5, 90}, "degrees, the same");
  k.pushes = t.integer("pushes", k.pushes, {1, 1000}, "at most");
  k.timeout = macrosteps(t.number("position_timeout", 30, {0, 3600}, "s, 0: for ever"));
  if (std::ranges::none_of(kSides, [&](Side side) { return has_room(k.hall, side, k.goal); }))
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("task.to: at ({:g}, {:g}), {:g} degrees there is no room for the box and two "
                    "platforms behind it",
                    to[0], to[1], to[2]),
        "choose a goal farther from walls and obstacles, or a larger room");
  return k;
}

PusherParameters read_pusher(const Config& config) {
  PusherParameters k;
  k.lost = config.section("task").number("position_lost", k.lost, {0.01, 10}, "m, standard deviation");
  return k;
}

}  // namespace mrroc::box_push
