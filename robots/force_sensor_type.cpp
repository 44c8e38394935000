#include "robots/force_sensor_type.hpp"

namespace mrroc::robots {

ForceSensorType read_force_sensor_type(const Config& config, const std::string& arm) {
  const bool wide =
      config.section("robots." + arm).choice("sensor", false, {{"si_65_5", false}, {"si_130_10", true}});
  if (!wide) return {};
  return {.range = {{130, 130, 400, 10, 10, 10}}, .coarseness = 2};
}

}  // namespace mrroc::robots
