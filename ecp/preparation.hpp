// Prepares the effector before the task begins.
#pragma once
#include "base/config.hpp"
#include "ecp/arm_links.hpp"

namespace mrroc::ecp {

/// Set in the driver before the task: SYNCHRO, then ROBOT_MODEL with its force bias at standstill.
struct Preparation {
  bool by_program{};            ///< nothing is set: the program does all of it itself
  RobotModel model{};           ///< tool and force tool
  int settling_macrosteps{50};  ///< at rest after SYNCHRO before the force sensor is biased
};

/// @return tool and force tool, from [robots.ARM.tool]: pose (angle-axis), weight, mass_centre; all required
/// @throws ConfigError
RobotModel read_tool_model(const Config& config, const std::string& arm);

/// Brings the driver into the state ready.
/// @return terminated when ready; aborted when the system stops; faulted when the driver refused, see
/// fault_of()
Outcome prepare_effector(ArmLinks& links, const Preparation& prepare);

/// @return the reason of the outcome faulted: the link's fault or the driver's refusal
Fault fault_of(const ArmLinks& links);

}  // namespace mrroc::ecp
