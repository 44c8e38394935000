#include "test/rig/cube_limits.hpp"

#include "robots/irb6/robot_type.hpp"
#include "tasks/rubik/config.hpp"
#include "test/rig/cube_cell.hpp"

namespace mrroc::rig {

std::vector<edp::Limits> cube_limits() {
  const Config config = Config::parse(std::string(rubik::config()), "rubik.toml");
  std::vector<edp::Limits> limits;
  for (const int arm : {rubik::kPostument, rubik::kTrack}) {
    const AxisVector start = rubik::meeting_joints(arm);
    const std::string& key = rubik::kArmKeys[static_cast<std::size_t>(arm)];
    const robots::RobotType& type = arm == rubik::kTrack ? irb6::track() : irb6::postument();
    limits.push_back(robots::read_driver(config, key, type, {start.begin(), start.end()}).driver.limits);
  }
  return limits;
}

}  // namespace mrroc::rig
