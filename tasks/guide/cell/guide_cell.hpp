// What the task must know of the robot and of the simulated cell: whether the tool reaches the fixture, and what his hand is like who leads it.
#pragma once
#include "base/config.hpp"
#include "tasks/guide/guide.hpp"

namespace mrroc::guide {

/// @param config  of a run @return the middle of the sheet of arm1 in its base, in which the simulated hand counts
/// @throws ConfigError
[[nodiscard]] Pose sheet_of(const Config& config);

/// @return compliance of the simulated hand, with its grip where it has a mass [m/N] @throws ConfigError
[[nodiscard]] double hand_compliance(const Config& config);

/// Refuses a fixture that the tool does not reach everywhere with the orientation that it has at the beginning, and one in the
/// table. @throws FaultError bad_configuration
void check_reach(const Config& config, const Setup& setup);

}  // namespace mrroc::guide
