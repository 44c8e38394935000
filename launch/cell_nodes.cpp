#include "launch/cell_nodes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "base/joined.hpp"
#include "robots/catalogue.hpp"
#include "sim/camera/config.hpp"
#include "sim/config.hpp"
#include "sim/shell/process.hpp"
#include "sim/start_joints.hpp"
#include "sim/world.hpp"

namespace mrroc::launch {
namespace {

constexpr const char* kSimulator = "simulator";  // the process, and its program

/// Robot type of an arm.
const robots::RobotType& type_of(const Config& config, const CellArm& arm) {
  return robots::read_type(config, arm.key, robots::catalogue(), arm.model);
}

/// @return how the driver of an arm reaches it, which is a way that its robot has
robots::HardwareChoice hardware_of(const Config& config, const CellArm& arm) {
  robots::HardwareChoice choice = robots::read_hardware(config, arm.key);
  const robots::RobotType& type = type_of(config, arm);
  std::ignore = robots::find_hardware(choice.kind, type.hardware, type.name, arm.key);
  return choice;
}

/// @return where the simulation of an arm begins
std::vector<double> start_of(const sim::ArmParameters& parameters, const std::string& key) {
  try {
    const AxisVector joints = sim::start_joints(parameters);
    return {joints.begin(), joints.end()};
  } catch (const std::invalid_argument& e) {
    throw FaultError(FaultCode::bad_configuration, fmt::format("robots.{}.start_joints: {}", key, e.what()));
  }
}

/// Whether the integration follows gears that give way is known only when the bodies stand.
void check_gears(const sim::WorldParameters& parameters) {
  const auto gives_way = [](const sim::ArmParameters& arm) { return arm.elasticity.frequency > 0; };
  if (std::ranges::any_of(parameters.arms, gives_way)) const sim::World world(parameters, 1);
}

/// Reads what the driver of an arm and the task's preparation will read. @param joints  where it stands
void read_arm(const Config& config, const CellArm& arm, const std::vector<double>& joints) {
  const robots::RobotType& type = type_of(config, arm);
  std::ignore = robots::read_driver(config, arm.key, type, joints);
  robots::read_tool(config, arm.key, type.driver);
  robots::read_command_link(config, "robots." + arm.key);
  robots::read_recording(config, "robots." + arm.key);
}

}  // namespace

std::vector<std::string> keys_of(const std::vector<CellArm>& arms) {
  std::vector<std::string> keys;
  for (const CellArm& arm : arms) keys.push_back(arm.key);
  return keys;
}

void check_cell(const Config& config, const std::vector<CellArm>& arms,
                const std::vector<CellPlatform>& platforms) {
  check_platforms(config, platforms);
  const std::vector<std::string> keys = keys_of(arms);
  if (config.texts("robots.order", keys) != keys)
    throw FaultError(FaultCode::bad_configuration,
                     keys.empty() ? "robots.order: this task has no arms, so the list is empty"
                                  : fmt::format("robots.order: this task has the arms {}, in this order",
                                                joined(keys, ", ")));
  std::vector<std::string> platform_keys;
  for (const CellPlatform& each : platforms) platform_keys.push_back(each.key);
  sim::read_camera_world(config, keys, platform_keys);
  if (arms.empty()) return;
  const sim::WorldParameters parameters = sim::read_world(config);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    // Only a real arm knows its own position: it homes, or the configuration gives the position.
    const bool real = hardware_of(config, arms[k]).real();
    read_arm(config, arms[k], real ? std::vector<double>{} : start_of(parameters.arms[k], arms[k].key));
  }
  check_gears(parameters);
}

mp::NodeSpec make_node(const Config& config, const std::string& name, const std::string& program,
                       const CellArm* arm, const link::NodeMain& body) {
  mp::NodeSpec p{name, program, {"--name", name}, {}};
  const std::string key = arm ? arm->key : "";
  if (arm) p.arguments.insert(p.arguments.end(), {"--arm", arm->key, "--robot", arm->model});
  p.body = [config = config.copy(), key, body](link::Process& process) { body(process, config, {key}); };
  return p;
}

std::vector<mp::NodeSpec> camera_nodes(const Config& config, const std::vector<std::string>& keys,
                                       const std::string& program, const link::NodeMain& body) {
  std::vector<mp::NodeSpec> nodes;
  for (const std::string& key : keys)
    nodes.push_back(make_node(config, "vsp-" + key, program, nullptr, body));
  return nodes;
}

std::vector<mp::NodeSpec> cell_nodes(const Config& config, const std::vector<CellArm>& arms,
                                     const std::vector<CellPlatform>& platforms) {
  std::vector<mp::NodeSpec> nodes;
  const auto simulated = [&](const CellArm& arm) {
    return robots::read_hardware(config, arm.key).simulated();
  };
  if (!platforms.empty() || std::ranges::any_of(arms, simulated))
    nodes.push_back(make_node(config, kSimulator, kSimulator, nullptr, sim::run_simulator_process));
  for (const CellArm& arm : arms) {
    const robots::RobotType& type = type_of(config, arm);
    nodes.push_back(
        make_node(config, "edp-" + arm.key, robots::driver_program(type), &arm, robots::driver_of({&type})));
    if (simulated(arm)) nodes.back().plant = kSimulator;
  }
  for (mp::NodeSpec& node : platform_nodes(config, platforms)) {
    nodes.push_back(std::move(node));
    nodes.back().plant = kSimulator;
  }
  return nodes;
}

}  // namespace mrroc::launch
