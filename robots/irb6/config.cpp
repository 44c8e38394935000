#include "robots/irb6/config.hpp"

#include "robots/driver_config.hpp"
#include "robots/irb6/homing.hpp"

namespace mrroc::irb6 {

std::unique_ptr<Arm> read_arm(const Config& config, const std::string& key, std::string_view model) {
  const Config table = config.section("robots." + key);
  const auto name = table.choice<std::string_view>(
      "model", model, {{"irb6_postument", "irb6_postument"}, {"irb6_track", "irb6_track"}});
  const auto set =
      table.choice("kinematics", ParameterSet::nominal,
                   {{"nominal", ParameterSet::nominal}, {"calibrated", ParameterSet::calibrated}});
  if (name == kPostument.name) return make_arm(name, model_number(set));
  const auto rule = table.choice("track", TrackRule::kept,
                                 {{"kept", TrackRule::kept},
                                  {"last_axis_kept", TrackRule::last_axis_kept},
                                  {"column_kept", TrackRule::column_kept}});
  return make_arm(name, model_number(set, rule));
}

namespace {

robots::DriverDefaults defaults_of(const Arm& arm) {
  const ArmParameters& p = arm.parameters();
  return {.T_WS = arm.sensor_in_wrist(),
          .T_WE = arm.tool_in_wrist(),
          .tool_weight = p.tool_weight,
          .tool_mass_centre = p.tool_mass_centre,
          .force_limit = p.force_limit,
          .homing = homing_of(p)};
}

}  // namespace

DriverSetup read_driver(const Config& config, const std::string& key, std::string_view model,
                        const std::vector<double>& synchro_joints) {
  DriverSetup s;
  s.arm = read_arm(config, key, model);
  s.driver = robots::read_driver(config, key, *s.arm, defaults_of(*s.arm), synchro_joints);
  return s;
}

RobotModel read_tool(const Config& config, const std::string& key, std::string_view model) {
  return robots::read_tool(config, key, defaults_of(*read_arm(config, key, model)));
}

}  // namespace mrroc::irb6
