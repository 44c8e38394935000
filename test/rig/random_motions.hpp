// Random files for the task `move`, and their execution by an arm of the simulator with its real driver.
#pragma once
#include <random>
#include <string>

#include "base/config.hpp"
#include "tasks/move/plan.hpp"

namespace mrroc::any_motion {

/// @param model  irb6_postument or irb6_track, of arm1
/// @return the text of a file: one arm, one to three motions by any generators in any representations
[[nodiscard]] std::string random_motions(std::mt19937& random, const std::string& model);

/// @return the configuration of a run with that file
[[nodiscard]] Config config_with(const std::string& file, const std::string& model);

/// What the execution of a plan has shown.
struct Execution {
  double goal_error_mm{};  ///< largest, of the measured pose at rest behind each motion
  double speed{};          ///< largest of all commanded set points, as a multiple of its limit
  double acceleration{};   ///< the same
  int violations{};        ///< commanded set points beyond a limit
};

/// Executes the motions of arm1 on the simulated arm.
/// @throws FaultError  the driver has refused a command or could not execute it
[[nodiscard]] Execution execute(const ArmPlan& plan, const std::string& model, std::uint64_t seed);

}  // namespace mrroc::any_motion
