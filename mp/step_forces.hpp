// Adds the forces of every step to a run's rows, which hold one value per macrostep.
#pragma once
#include <string>

#include "base/link/log_reader.hpp"
#include "mp/arm_trace.hpp"

namespace mrroc::mp {

/// Sets ArmRow::F_most from what the driver has told of its steps.
/// @param log  of the run that the rows are of @param arm  key of the arm, "arm1"
void add_step_forces(ArmTrace& trace, const link::LogReader& log, const std::string& arm);

}  // namespace mrroc::mp
