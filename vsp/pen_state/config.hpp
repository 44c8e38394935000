// The pen-state sensor's part of the configuration, and its process.
#pragma once
#include "base/link/child_main.hpp"
#include "vsp/pen_state/pen_state_sensor.hpp"

namespace mrroc::vsp {

/// @return the thresholds in the table [pen_state]
/// @throws ConfigError
PenStateParameters read_pen_state(const Config& config);

/// Builds the sensor of one arm and runs its shell: channel ARM.pen_state.
void run_pen_state(link::Process& process, const Config& config, const link::NodeArguments& arguments);

}  // namespace mrroc::vsp
