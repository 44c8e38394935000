#include "mp/check_run.hpp"

#include <set>
#include <string>

#include "base/instructions.hpp"
#include "base/link/log_check.hpp"

namespace mrroc::mp {

int check_coordinator(const std::string& task, const TaskOptions& options,
                      const std::vector<std::string>& arms,
                      const std::function<std::unique_ptr<CoordinatorRun>(TaskRun&)>& make) {
  const link::LogReader log(options.check);
  const auto body = [&](link::Process& process) {
    TaskRun run(task, process, options.check, arms);
    const std::unique_ptr<CoordinatorRun> coordinator = make(run);
    if (process.assemble()) coordinator->execute();
  };
  // Orders from terminals are in scripts, with the macrosteps in which they were taken.
  std::set<std::string> of_terminals{"operator"};
  for (const InstructionSet& set : instruction_sets()) of_terminals.emplace(set.channel);
  return link::report_verdict(link::check_process(log, "mp", options.clock, body, of_terminals));
}

}  // namespace mrroc::mp
