// Checks the coordinator's side of a logged run (base/link/log_check.hpp): the task's own program runs once
// more on what MP received.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "mp/coordinator_run.hpp"
#include "mp/options.hpp"
#include "mp/task_run.hpp"

namespace mrroc::mp {

/// Executes a coordinator on the log of the run folder TaskOptions::check, and prints the verdict. The operator's
/// orders come from the run's operator.script.
/// @param make  makes the coordinator, as for a run
/// @return exit status: 1 when there are differences, otherwise 0
/// @throws FaultError bad_log, bad_script
int check_coordinator(const std::string& task, const TaskOptions& options,
                      const std::vector<std::string>& arms,
                      const std::function<std::unique_ptr<CoordinatorRun>(TaskRun&)>& make);

}  // namespace mrroc::mp
