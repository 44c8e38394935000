// An IRb-6 and its driver from the configuration.
#pragma once
#include <memory>

#include "base/config.hpp"
#include "base/effector_command.hpp"
#include "edp/driver_parameters.hpp"
#include "robots/irb6/arm.hpp"

namespace mrroc::irb6 {

/// What the table [robots.ARM] says.
struct DriverSetup {
  std::unique_ptr<Arm> arm;      ///< never null
  edp::DriverParameters driver;  ///< for the driver of this arm
};

/// @param key    of the arm, e.g. "arm1"
/// @param model  fallback for the robot's name
/// @return the arm alone, with the kinematic model of the configuration
/// @throws ConfigError
std::unique_ptr<Arm> read_arm(const Config& config, const std::string& key, std::string_view model);

/// @param key             of the arm, e.g. "arm1"
/// @param model           fallback for the robot's name
/// @param synchro_joints  joints at which SYNCHRO finds the arm [rad], track [m], when it is known: then
///        SYNCHRO believes it unless the configuration says "homing"; empty: the other way round
/// @throws ConfigError
DriverSetup read_driver(const Config& config, const std::string& key, std::string_view model,
                        const std::vector<double>& synchro_joints);

/// @return tool and force tool that a control subsystem sets before the task, from [robots.ARM.tool]
RobotModel read_tool(const Config& config, const std::string& key, std::string_view model);

}  // namespace mrroc::irb6
