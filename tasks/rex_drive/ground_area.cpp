#include "tasks/rex_drive/ground_area.hpp"

#include <string>

namespace mrroc::rex_drive {

std::vector<GroundArea> read_areas(const Config& config) {
  std::vector<GroundArea> areas;
  for (const std::string& name : config.tables("sim.ground.patches")) {
    const Config t = config.section("sim.ground.patches." + name);
    const auto area = t.numbers<4>("area", Config::kRequired);
    areas.push_back({.lower = {area[0], area[1]},
                     .upper = {area[2], area[3]},
                     .scale = t.number("scale", Config::kRequired),
                     .from = t.number("from", Config::kRequired)});
  }
  return areas;
}

}  // namespace mrroc::rex_drive
