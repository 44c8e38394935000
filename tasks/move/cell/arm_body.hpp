// Joins the task `move` with the robots: their kinematics, and a rehearsal of a plan by their drivers.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "base/config.hpp"
#include "base/link/child_main.hpp"
#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {

/// @param arm  key: [robots.ARM] names the model and the tool
/// @throws ConfigError
[[nodiscard]] std::unique_ptr<Body> make_arm_body(const Config& config, const std::string& arm);

/// Executes the motions of one arm with its real driver and drives that follow at once: what the driver would refuse or
/// could not execute to its end is found before anything moves. Contact forces are none.
/// @throws FaultError  the first violation, with the motion and the time in it
void rehearse(const Config& config, const ArmPlan& plan);

/// The same for all arms.
void rehearse(const Config& config, const Plan& plan);

/// Body of the ECP of the task `move`.
void run_move_ecp(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::any_motion
