#include "mp/run_end.hpp"

#include <fmt/core.h>

#include "mp/black_box.hpp"

namespace mrroc::mp {

std::optional<Fault> why_not_done(const Supervisor& supervisor, Outcome outcome) {
  if (supervisor.fault()) return supervisor.fault();
  if (outcome != Outcome::terminated)
    return Fault{.code = FaultCode::ended_early,
                 .process = "mp",
                 .text = "the task's program did not come to its end, and nobody had stopped it"};
  if (const std::string name = supervisor.without_fingerprint(); !name.empty() || supervisor.log_hash() == 0)
    return Fault{
        .code = FaultCode::no_fingerprint, .process = name, .text = fmt::format("{} has not told it", name)};
  return std::nullopt;
}

Summary summarize(const EndedRun& run, const Supervisor& supervisor, RunLog& log) {
  Summary summary{.task = run.task,
                  .fault = why_not_done(supervisor, run.outcome),
                  .sim_s = run.sim_s,
                  .wall_s = run.wall_s,
                  .log_hash = supervisor.log_hash(),
                  .figures = {},
                  .survived = run.survived};
  if (!log.close() && !summary.fault) summary.fault = log_fault();
  const FaultCode code = summary.fault ? summary.fault->code : FaultCode::none;
  summary.stopped = is_operators_word(code);
  log.report_figures(summary.figures);
  if (const auto steps = supervisor.stop_steps(); summary.fault && steps)
    summary.figures["stop_steps_max"] = static_cast<double>(*steps);
  if (run.late) summary.figures["late_periods"] = static_cast<double>(*run.late);
  if (summary.fault && (!summary.stopped || code == FaultCode::emergency_stop))
    summary.black_box = write_black_box(run.folder, run.roster);
  else if (!run.survived.empty())
    summary.black_box = black_box_files(run.folder);
  try {
    write_summary(run.folder, summary);
  } catch (const FaultError& e) {
    if (!summary.fault) summary.fault = e.fault();
  }
  return summary;
}

}  // namespace mrroc::mp
