// Constants of one platform's effector driver, from the configuration.
#pragma once
#include <string>

#include "base/platform_command.hpp"
#include "base/step_interval.hpp"

namespace mrroc::edp {

/// Everything that a PlatformDriver must know beyond its platform.
struct PlatformDriverParameters {
  std::string estimator;  ///< one of Platform::estimators(); empty: the first
  std::string tracker;    ///< one of Platform::trackers(); empty: the first
  bool adapt{true};       ///< the tracker uses the estimated slip as soon as it is certain enough
  Slip nominal{};  ///< slip that it uses before, and without `adapt`; its friction is the most that it uses
  int start_guard_steps{};     ///< as DriverParameters has it
  double synchro_rest{1};      ///< for which SYNCHRO measures the platform at rest [s], 0.1..60
  double synchro_timeout{10};  ///< for SYNCHRO as a whole [s], longer than synchro_rest, at most 600
  int silence{10};      ///< macrosteps without a message of the owner after which the platform stops, >= 1
  int brake_after{25};  ///< macrosteps at rest at the end of a way after which the drives brake, >= 1
  StepInterval solver_fails{};  ///< steps of the estimate with which the tracker fails on purpose
};

}  // namespace mrroc::edp
