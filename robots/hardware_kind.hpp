// Kinds of robot for an effector driver: simulated, a loop-back, or hardware of the robot's own.
#pragma once
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/config.hpp"
#include "base/link/process.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/hardware.hpp"
#include "edp/robot.hpp"

namespace mrroc::robots {

/// Parameters with which hardware is opened.
struct HardwareContext {
  link::Process& process;                   ///< of the driver; outlives the hardware
  const Config& config;                     ///< of the run: a robot's own keys are in the section robots.ARM
  const std::string& arm;                   ///< key of the robot, e.g. "arm1"
  const edp::Robot& robot;                  ///< its kernel; outlives the hardware
  const edp::DriverParameters& parameters;  ///< of its driver
};

/// One way to reach a robot.
struct HardwareKind {
  std::string_view name;  ///< as in `--hardware NAME` and [robots.ARM] hardware
  edp::AnyHardware (*open)(
      const HardwareContext&);  ///< called before the process assembles; may throw FaultError
};

/// The kinds that every robot has: "simulated", over the link, and "loopback", a LoopbackPlant.
[[nodiscard]] std::span<const HardwareKind> common_hardware();

/// The usual kind.
inline constexpr std::string_view kSimulated = "simulated";
/// That of tests without a simulator.
inline constexpr std::string_view kLoopback = "loopback";

/// The connection to a robot, from [robots.ARM].
struct HardwareChoice {
  std::string kind{kSimulated};  ///< `hardware`: name of a HardwareKind
  int core{-1};                  ///< `core`: on which the driver runs by the wall clock; -1: on any

  /// @return whether the simulator has the robot
  [[nodiscard]] bool simulated() const { return kind == kSimulated; }
  /// @return whether the arm stands where nobody but itself knows
  [[nodiscard]] bool real() const { return !simulated() && kind != kLoopback; }
};

/// @param arm  key of the robot
/// @throws ConfigError
[[nodiscard]] HardwareChoice read_hardware(const Config& config, const std::string& arm);

/// @param name  of the kind  @param own  kinds of the robot itself, beside the common ones
/// @param robot  its name  @param arm  its key
/// @return the kind, which lives as long as its list
/// @throws FaultError bad_configuration  the robot has no such kind; it names those that it has
[[nodiscard]] const HardwareKind& find_hardware(const std::string& name, std::span<const HardwareKind> own,
                                                std::string_view robot, const std::string& arm);

/// @param name  of the kind  @param own  as in find_hardware()
/// @throws FaultError bad_configuration, see find_hardware(); what opening throws
[[nodiscard]] edp::AnyHardware open_hardware(const std::string& name, std::span<const HardwareKind> own,
                                             const HardwareContext& context);

}  // namespace mrroc::robots
