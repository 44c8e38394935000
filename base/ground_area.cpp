#include "base/ground_area.hpp"

#include <string>

namespace mrroc {

DriveGround read_ground(const Config& config) {
  return {.friction = config.numbers<2>("sim.ground.friction", Config::kRequired),
          .areas = read_ground_areas(config),
          .smooth = config.text("sim.ground.model", Config::kRequired) == "smooth"};
}

std::vector<GroundArea> read_ground_areas(const Config& config) {
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

}  // namespace mrroc
