#include "robots/hardware_kind.hpp"

#include <fmt/core.h>

#include <array>

#include "edp/loopback_hardware.hpp"
#include "edp/simulated_hardware.hpp"

namespace mrroc::robots {
namespace {

edp::AnyHardware open_simulated(const HardwareContext& c) {
  return edp::SimulatedHardware(c.process, c.arm, "simulator", c.parameters.dt);
}

edp::AnyHardware open_loopback(const HardwareContext& c) {
  const AxisVector& joints = c.parameters.synchro_joints;
  const AxisVector motors =
      joints.size() == c.robot.axes() ? c.robot.motors_from_joints(joints) : AxisVector::Zero(c.robot.axes());
  return edp::LoopbackHardware(edp::LoopbackPlant(c.robot, motors, c.parameters.dt), c.parameters.dt,
                               !c.process.lock_step());
}

constexpr std::array kCommon{HardwareKind{kSimulated, open_simulated},
                             HardwareKind{kLoopback, open_loopback}};

}  // namespace

std::span<const HardwareKind> common_hardware() { return kCommon; }

HardwareChoice read_hardware(const Config& config, const std::string& arm) {
  const Config table = config.section("robots." + arm);
  HardwareChoice choice;
  choice.kind = table.text("hardware", choice.kind);
  choice.core = table.integer("core", choice.core, {-1, 1023}, "of the host, -1: any");
  return choice;
}

const HardwareKind& find_hardware(const std::string& name, std::span<const HardwareKind> own,
                                  std::string_view robot, const std::string& arm) {
  std::string known;
  for (const std::span<const HardwareKind> kinds : {common_hardware(), own})
    for (const HardwareKind& kind : kinds) {
      if (kind.name == name) return kind;
      known += (known.empty() ? "" : ", ") + std::string(kind.name);
    }
  throw FaultError(
      FaultCode::bad_configuration,
      fmt::format("robots.{}.hardware: {} has no hardware '{}'; it has {}", arm, robot, name, known));
}

edp::AnyHardware open_hardware(const std::string& name, std::span<const HardwareKind> own,
                               const HardwareContext& context) {
  return find_hardware(name, own, context.robot.name(), context.arm).open(context);
}

}  // namespace mrroc::robots
