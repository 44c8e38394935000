#include "vsp/pen_state/config.hpp"

#include "vsp/shell.hpp"

namespace mrroc::vsp {

PenStateParameters read_pen_state(const Config& config) {
  PenStateParameters p;
  const Config t = config.section("pen_state");
  p.dt = config.number("time.dt", p.dt, {0.002, 0.002}, "s");
  p.v_filter = t.number("v_filter", p.v_filter, {0, 1}, "s");
  p.F_filter = t.number("F_filter", p.F_filter, {0, 1}, "s");
  p.tremor_period = t.number("tremor_period", p.tremor_period, {0.002, 0.5}, "s");
  p.tremor_memory = t.number("tremor_memory", p.tremor_memory, {0.1, 10}, "s");
  p.lowering_speed = t.number("lowering_speed", p.lowering_speed, {0.0005, 0.1}, "m/s");
  p.braked_speed = t.number("braked_speed", p.braked_speed, {0.0005, 0.1}, "m/s");
  p.rest_speed = t.number("rest_speed", p.rest_speed, {0, 0.1}, "m/s");
  p.rest_time = t.number("rest_time", p.rest_time, {0, 10}, "s");
  p.touch_height = t.number("touch_height", p.touch_height, {0.0001, 0.01}, "m");
  p.impact_force = t.number("impact_force", p.impact_force, {0.1, 20}, "N");
  p.impact_time = t.number("impact_time", p.impact_time, {0.002, 0.098}, "s");
  p.stop_share = t.number("stop_share", p.stop_share, {0, 1});
  p.stop_force = t.number("stop_force", p.stop_force, {0, 20}, "N");
  p.rest_force = t.number("rest_force", p.rest_force, {0.1, 20}, "N");
  p.rest_force_time = t.number("rest_force_time", p.rest_force_time, {0, 10}, "s");
  p.sink_depth = t.number("sink_depth", p.sink_depth, {0.0003, 0.05}, "m");
  p.lift_height = t.number("lift_height", p.lift_height, {0.0001, 0.02}, "m");
  p.paper.slope = t.number("slope", p.paper.slope, {0.0001, 0.5}, "rad");
  p.paper.roughness = t.number("roughness", p.paper.roughness, {1e-5, 0.01}, "m");
  p.paper.correlation = t.number("correlation", p.paper.correlation, {0.002, 10}, "s");
  p.paper.memory = t.number("memory", p.paper.memory, {0.1, 1000}, "s");
  return p;
}

void run_pen_state(link::Process& process, const Config& config, const link::NodeArguments& arguments) {
  run_step_sensor(process, arguments.arm, arguments.arm + ".pen_state",
                  PenStateSensor(read_pen_state(config)));
}

}  // namespace mrroc::vsp
