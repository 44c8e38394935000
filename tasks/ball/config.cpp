#include "tasks/ball/config.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <tuple>

#include "tasks/ball/grip.hpp"

namespace mrroc::ball {
namespace {

constexpr Bounds kForce{.min = 5, .max = 60};  // of both palms on the object [N]

/// What to do where a force is needed.
std::string remedy_of(const Parameters& k, double needed) {
  const std::string more = fmt::format("press with more by --set task.force={:.0f}", std::ceil(needed));
  if (std::ceil(needed) > kForce.max)
    return fmt::format("take a lighter or rougher object: task.force is {:g} N at most", kForce.max);
  if (std::ceil(needed) >= k.most_force)
    return fmt::format(
        "take a lighter or rougher object: this one bears {:g} N (task.most_force), and may not be pressed "
        "with more",
        k.most_force);
  return more + ", or take a lighter or rougher object";
}

/// The least force with which friction holds the object as it is told.
void check_grip(const Parameters& k) {
  const double needed = needed_force(k.body.mass, k.body.friction, k.margin);
  if (k.force < needed)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format(
            "the object of {:g} kg cannot be held by {:g} N: with friction {:g} on both palms it would "
            "slide; {:.1f} N are needed",
            k.body.mass, k.force, k.body.friction, needed),
        remedy_of(k, needed));
  if (k.force >= k.most_force)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("task.force: {:g} N would crush the object, which bears {:g} N", k.force, k.most_force),
        "take less than task.most_force");
}

}  // namespace

Parameters read_parameters(const Config& config) {
  std::ignore = config.number("time.dt", kPacing.dt, {kPacing.dt, kPacing.dt}, "s");
  std::ignore = config.integer("time.n_s", kPacing.n_s, {kPacing.n_s, kPacing.n_s}, "steps");
  const auto body = read_free_body(config);
  if (!body)
    throw FaultError(FaultCode::bad_configuration, "free_body.shape: there is nothing to carry",
                     "set it to ball or box");
  const Config t = config.section("task");
  Parameters k;
  k.body = *body;
  k.force = t.number("force", k.force, kForce, "N, of both palms on the object");
  k.radius = t.number("radius", k.radius, {0.01, 0.15}, "m");
  k.turn = t.integer("turn", k.turn, {400, 10'000}, "macrosteps of one turn");
  k.lift = t.number("lift", k.lift, {0.01, 0.1}, "m");
  k.gap = t.number("gap", k.gap, {0.02, 0.06}, "m, between palms and object at the beginning");
  k.touch = t.number("touch", k.touch, {0.8, 4}, "N, at which the approach settles");
  k.most_force = t.number("most_force", k.most_force, {10, 100}, "N, that the object bears");
  k.least_force = t.number("least_force", k.least_force, {0.5, 20}, "N, below which nothing is held");
  k.margin = t.number("margin", k.margin, {1, 5}, "times the weight that friction must bear");
  k.size_tolerance =
      t.number("size_tolerance", k.size_tolerance, {0.01, 0.3}, "share by which the size may differ");
  check_grip(k);
  return k;
}

std::optional<HandPush> read_hand_push(const Config& config) {
  const Config t = config.section("hand");
  const int arm = t.choice("arm", -1, {{"none", -1}, {"arm1", 0}, {"arm2", 1}});
  if (arm < 0) return {};
  HandPush p;
  p.arm = static_cast<std::size_t>(arm);
  const auto f =
      t.numbers<3>("force", std::array{p.force.x(), p.force.y(), p.force.z()}, {-30, 30}, "N, in the world");
  p.force = {f[0], f[1], f[2]};
  p.begin = t.integer("begin", p.begin, {0, 10'000}, "macrosteps around the circle");
  p.duration = t.integer("duration", p.duration, {1, 10'000}, "macrosteps");
  return p;
}

}  // namespace mrroc::ball
