#include "launch/calibrated.hpp"

#include <string>
#include <tuple>
#include <vector>

namespace mrroc::launch {

void take_calibrated(const Config& config) {
  if (!config.has("calibration.run")) return;
  std::ignore = config.text("calibration.run", "");
  const std::vector<std::string> none;
  for (const std::string& arm : config.texts("calibration.robots", none)) {
    if (const std::string key = "cell.robots." + arm + ".place"; config.has(key))
      std::ignore =
          config.list(key, std::vector<double>{}, {-10, 10}, "m, rad; empty: as robots." + arm + ".place");
    if (const std::string key = "robots." + arm + ".kinematics"; config.has(key))
      std::ignore = config.text(key, "");
    const Config tool = config.section("robots." + arm + ".tool");
    if (tool.has("weight")) std::ignore = tool.number("weight", Config::kRequired, {0, 50}, "N");
    if (tool.has("mass_centre"))
      std::ignore = tool.numbers<3>("mass_centre", Config::kRequired, {-1, 1}, "m");
  }
  for (const std::string& camera : config.texts("calibration.cameras", none))
    if (const std::string key = "cell.cameras." + camera + ".pose"; config.has(key))
      std::ignore =
          config.list(key, std::vector<double>{}, {-10, 10}, "m, rad; empty: as cameras." + camera + ".pose");
}

}  // namespace mrroc::launch
