#include "sim/cube_limits.hpp"

#include "robots/irb6/config.hpp"
#include "sim/cube_cell.hpp"
#include "tasks/rubik/config.hpp"

namespace mrroc::sim {

std::vector<edp::Limits> cube_limits() {
  const Config config = Config::parse(std::string(rubik::config()), "rubik.toml");
  std::vector<edp::Limits> limits;
  for (const int arm : {kPostument, kTrack}) {
    const AxisVector start = meeting_joints(arm);
    const std::string& key = rubik::kArmKeys[static_cast<std::size_t>(arm)];
    limits.push_back(irb6::read_driver(config, key, "", {start.begin(), start.end()}).driver.limits);
  }
  return limits;
}

}  // namespace mrroc::sim
