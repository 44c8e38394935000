#include "launch/platform_nodes.hpp"

#include <fmt/core.h>

#include <tuple>

#include "base/joined.hpp"
#include "edp/platform/driver.hpp"
#include "edp/platform/synchronisation.hpp"
#include "launch/cell_nodes.hpp"
#include "robots/driver_config.hpp"
#include "robots/platforms.hpp"
#include "sim/platform/config.hpp"

namespace mrroc::launch {

std::vector<std::string> keys_of(const std::vector<CellPlatform>& platforms) {
  std::vector<std::string> keys;
  for (const CellPlatform& platform : platforms) keys.push_back(platform.key);
  return keys;
}

namespace {

/// SYNCHRO needs some positions of a platform that stands.
void check_synchro(const std::string& key, const edp::PlatformDriverParameters& driver,
                   const MotionCaptureSetup& capture) {
  const std::int64_t steps = capture.period * (edp::PlatformSynchronisation::kPoses + 1) + capture.latency;
  const double needed = static_cast<double>(steps) * edp::PlatformDriver::kStep;
  if (needed >= driver.synchro_timeout)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("platforms.{}.synchro_timeout: {:g} s are too short for motion_capture.period = {} steps",
                    key, driver.synchro_timeout, capture.period),
        fmt::format("make it longer than {:g} s, or motion_capture.period shorter", needed));
}

}  // namespace

void check_platforms(const Config& config, const std::vector<CellPlatform>& platforms) {
  if (platforms.empty()) return;
  const std::vector<std::string> keys = keys_of(platforms);
  if (robots::read_platform_order(config) != keys)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("platforms.order: this task has the platforms {}, in this order", joined(keys, ", ")));
  const sim::PlatformWorldParameters world = sim::read_platform_world(config, keys, robots::platforms());
  for (const std::string& key : keys) {
    const robots::PlatformType& type = robots::read_platform_type(config, key, robots::platforms());
    check_synchro(key, robots::read_platform_driver(config, key, type), world.motion_capture.setup);
    robots::read_command_link(config, "platforms." + key);
    robots::read_recording(config, "platforms." + key);
  }
}

std::vector<mp::NodeSpec> platform_nodes(const Config& config, const std::vector<CellPlatform>& platforms) {
  std::vector<mp::NodeSpec> nodes;
  for (const CellPlatform& platform : platforms) {
    const robots::PlatformType& type = robots::read_platform_type(config, platform.key, robots::platforms());
    const CellArm effector{platform.key, platform.model};
    nodes.push_back(make_node(config, "edp-" + platform.key, robots::driver_program(type), &effector,
                              robots::platform_driver_of({&type})));
  }
  return nodes;
}

}  // namespace mrroc::launch
