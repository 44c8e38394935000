// Reads the table [robots.ARM] of a configuration: the part that is the same for drivers of all robots.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "base/config.hpp"
#include "base/effector_command.hpp"
#include "base/link/child_main.hpp"
#include "base/link/injection.hpp"
#include "edp/driver_parameters.hpp"
#include "edp/recorder.hpp"
#include "edp/robot.hpp"
#include "robots/hardware_kind.hpp"

namespace mrroc::robots {

/// Defaults from a robot's own data, where the configuration gives no value.
struct DriverDefaults {
  Pose T_WS;                                 ///< force/torque sensor in the wrist
  Pose T_WE;                                 ///< usual tool in the wrist
  double tool_weight{};                      ///< w, of everything beyond the sensor [N]
  std::array<double, 3> tool_mass_centre{};  ///< P = W_G P [m], in W
  std::array<double, 6> force_limit{};       ///< largest contact force along and about the axes of E [N, N m]
  edp::HomingParameters homing;              ///< of a robot that is homed
};

/// @param key             of the arm, e.g. "arm1"
/// @param synchro_joints  joints at which SYNCHRO finds the arm [rad], track [m], when it is known: then
///        SYNCHRO believes it unless the configuration says "homing"; empty: the other way round
/// @return parameters of the driver, from [robots.ARM] and [time]
/// @throws ConfigError
edp::DriverParameters read_driver(const Config& config, const std::string& key, const edp::Robot& robot,
                                  const DriverDefaults& defaults, const std::vector<double>& synchro_joints);

/// @return tool and force tool that a control subsystem sets before the task, from [robots.ARM.tool]
/// @throws ConfigError
RobotModel read_tool(const Config& config, const std::string& key, const DriverDefaults& defaults);

/// @param table  of an arm or a platform, e.g. "robots.arm1" @return when its steps are written down, `record`
edp::Recording read_recording(const Config& config, const std::string& table);

/// @param table  of an arm or a platform, e.g. "robots.arm1"
/// @return faults made on purpose on its link KEY.command, `command_link`
link::Injection read_command_link(const Config& config, const std::string& table);

/// Runs the effector driver of an arm until its system ends, with the hardware that the arguments or the configuration
/// name.
/// @param own  kinds of hardware that the robot has beside the common ones
/// @throws ConfigError; FaultError bad_configuration  the arm is not among [robots] order
void run_driver(link::Process& process, const Config& config, const link::NodeArguments& arguments,
                const edp::Robot& robot, const edp::DriverParameters& parameters,
                std::span<const HardwareKind> own = {});

}  // namespace mrroc::robots
