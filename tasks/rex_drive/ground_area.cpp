#include "tasks/rex_drive/ground_area.hpp"

#include <string>

namespace mrroc::rex_drive {

DriveGround read_ground(const Config& config) {
  DriveGround ground{.friction = config.numbers<2>("sim.ground.friction", Config::kRequired), .areas = {}};
  for (const std::string& name : config.tables("sim.ground.patches")) {
    const Config t = config.section("sim.ground.patches." + name);
    const auto area = t.numbers<4>("area", Config::kRequired);
    ground.areas.push_back({.lower = {area[0], area[1]},
                            .upper = {area[2], area[3]},
                            .scale = t.number("scale", Config::kRequired),
                            .from = t.number("from", Config::kRequired)});
  }
  return ground;
}

}  // namespace mrroc::rex_drive
