#include "tasks/drawing/config.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tasks/drawing/conveyor.hpp"

namespace mrroc::drawing {

Parameters read_parameters(const Config& config) {
  Parameters k;
  k.dt = config.number("time.dt", k.dt, {0.002, 0.002}, "s");
  k.n_s = config.integer("time.n_s", k.n_s, {2, 32}, "steps");
  k.teach_force = config.number("task.teach_force", k.teach_force, {0, 5}, "N");
  k.draw_force = config.number("task.draw_force", k.draw_force, {0.1, 5}, "N");
  k.settle = config.integer("task.settle", k.settle, {0, 500}, "macrosteps");
  k.touch_timeout = config.integer("task.touch_timeout", k.touch_timeout, {10, 10000}, "macrosteps of m = 4");
  k.lift_off = config.integer("task.lift_off", k.lift_off, {10, 250}, "macrosteps");
  k.pause = static_cast<int>(
      config.integer("task.pause_macrosteps", k.pause, {1, 100}, "macrosteps from full pace to rest"));
  k.belt_runs = read_belt_speed(config) > 0;
  if (k.belt_runs) k.belt_lag = config.number("task.belt_lag", k.belt_lag, {-2, 2}, "macrosteps");
  return k;
}

void check_macrostep(const Taught& taught, const Parameters& k, const std::string& file) {
  const double macrostep_s = k.dt * k.n_s;
  if (std::abs(taught.recording.macrostep_s() - macrostep_s) < 1e-9) return;
  throw FileError(file, 0,
                  fmt::format("taught with macrosteps of {:g} s, the task has {:g} s",
                              taught.recording.macrostep_s(), macrostep_s),
                  "set time.n_s as it was, or teach anew");
}

HandPlan read_hand_plan(const Config& config, const Point& start) {
  HandPlan plan;
  const auto xy = config.numbers<2>("operator.start", std::array{start.x(), start.y()}, {-500, 500}, "mm");
  plan.start = Point(xy[0], xy[1]);
  plan.height = config.number("operator.start_height", plan.height, {0.004, 0.03}, "m");
  plan.steady = config.integer("operator.steady", plan.steady, {1, 500}, "macrosteps");
  return plan;
}

}  // namespace mrroc::drawing
