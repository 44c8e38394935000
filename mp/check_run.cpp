#include "mp/check_run.hpp"

#include "base/link/log_check.hpp"

namespace mrroc::mp {

int check_coordinator(const std::string& task, const TaskOptions& options,
                      const std::vector<std::string>& arms, const std::function<void(TaskRun&)>& execute) {
  const link::LogReader log(options.check);
  const auto body = [&](link::Process& process) {
    TaskRun run(task, process, options.check, arms);
    execute(run);
  };
  // What came from terminals is in scripts, with the macrosteps in which it was taken.
  return link::report_verdict(
      link::check_process(log, "mp", options.clock, body, {"operator", "manual.words"}));
}

int check_solo_run(const std::string& task, const TaskOptions& options, SoloParameters parameters) {
  parameters.gives_start = false;
  parameters.watch = nullptr;
  return check_coordinator(task, options, parameters.arms, [&](TaskRun& run) {
    SoloRun solo(run, parameters, [](const std::string&) {});
    if (run.process().assemble()) solo.execute();
  });
}

}  // namespace mrroc::mp
