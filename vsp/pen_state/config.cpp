#include "vsp/pen_state/config.hpp"

#include "vsp/shell.hpp"

namespace mrroc::vsp {

PenStateParameters read_pen_state(const Config& config) {
  PenStateParameters p;
  const Config t = config.section("pen_state");
  p.dt = config.number("time.dt", p.dt, {0.002, 0.002}, "s");
  p.v_filter = t.number("v_filter", p.v_filter, {0, 1}, "s");
  p.F_filter = t.number("F_filter", p.F_filter, {0, 1}, "s");
  p.lowering_speed = t.number("lowering_speed", p.lowering_speed, {0.0005, 0.1}, "m/s");
  p.braked_speed = t.number("braked_speed", p.braked_speed, {0.0005, 0.1}, "m/s");
  p.rest_speed = t.number("rest_speed", p.rest_speed, {0, 0.1}, "m/s");
  p.rest_time = t.number("rest_time", p.rest_time, {0, 10}, "s");
  p.impact_force = t.number("impact_force", p.impact_force, {0.1, 20}, "N");
  p.impact_time = t.number("impact_time", p.impact_time, {0.002, 0.098}, "s");
  p.rest_force = t.number("rest_force", p.rest_force, {0.1, 20}, "N");
  p.rest_force_time = t.number("rest_force_time", p.rest_force_time, {0, 10}, "s");
  p.settling_time = t.number("settling_time", p.settling_time, {0, 5}, "s");
  p.paper_filter = t.number("paper_filter", p.paper_filter, {0.01, 10}, "s");
  p.sink_depth = t.number("sink_depth", p.sink_depth, {0.0003, 0.05}, "m");
  p.lift_height = t.number("lift_height", p.lift_height, {0.0001, 0.01}, "m");
  p.lift_speed = t.number("lift_speed", p.lift_speed, {0.0005, 0.1}, "m/s");
  p.pull_force = t.number("pull_force", p.pull_force, {0.5, 50}, "N");
  return p;
}

void run_pen_state(link::Process& process, const Config& config, const link::PartArguments& arguments) {
  run_step_sensor(process, arguments.arm, arguments.arm + ".pen_state",
                  PenStateSensor(read_pen_state(config)));
}

}  // namespace mrroc::vsp
