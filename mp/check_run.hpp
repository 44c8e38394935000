// The check of the coordinator's side of a logged run (base/link/log_check.hpp): the task's own program runs
// once more on what MP received.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "mp/options.hpp"
#include "mp/solo_run.hpp"
#include "mp/task_run.hpp"

namespace mrroc::mp {

/// Runs a coordinator on the log of the run folder TaskOptions::check, and prints the verdict. The operator's
/// orders come from the run's operator.script.
/// @param execute  makes the coordinator and executes it, as for a run
/// @return exit status: 1 when there are differences, otherwise 0
/// @throws FaultError bad_log, bad_script
int check_coordinator(const std::string& task, const TaskOptions& options,
                      const std::vector<std::string>& arms, const std::function<void(TaskRun&)>& execute);

/// The same for a task whose arms work on their own.
int check_solo_run(const std::string& task, const TaskOptions& options, SoloParameters parameters);

}  // namespace mrroc::mp
