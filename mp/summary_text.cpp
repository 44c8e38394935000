#include "mp/summary_text.hpp"

#include <fmt/core.h>

#include <cstdio>

#include "base/command_hint.hpp"
#include "base/counted.hpp"
#include "base/print.hpp"

namespace mrroc::mp {
namespace {

/// A run in lock-step is over before anybody has opened the page.
std::string view_hint(const Summary& s, const Ending& ending, const TaskOptions& o) {
  if (!o.view || o.speed > 0 || o.clock == ClockKind::wall) return "";
  return fmt::format(
      "that was as fast as this host can; `./run {} --view --speed 1` takes as long as arms do,\n"
      "and `ui_cli view {}` shows this run once more\n",
      s.task, ending.folder.string());
}

}  // namespace

std::string ending_text(const Summary& s, const Ending& ending, const TaskOptions& options) {
  std::string text = fmt::format("\n{}: {:.1f} s simulated in {:.1f} s ({:.1f} x real time)\n",
                                 s.stopped ? "stopped"
                                 : s.fault ? "ended with a fault"
                                           : "done",
                                 s.sim_s, s.wall_s, s.wall_s > 0 ? s.sim_s / s.wall_s : 0);
  text += ending.figures;
  for (const RecoverableFault& recovered : s.survived)
    text += fmt::format("fault at {:.2f} s, after which the task went on: {}\n", recovered.sim_s,
                        describe(recovered.fault));
  if (!s.black_box.empty())
    text += fmt::format("black box, the last 5 s of every process: {} in the run folder, such as {}\n",
                        counted(s.black_box.size(), "file"), s.black_box.front());
  for (const std::filesystem::path& picture : ending.pictures)
    text += fmt::format("picture: {}\n", picture.string());
  return command_hint(text + view_hint(s, ending, options), options.session);
}

int print_ending(const Summary& summary, const Ending& ending, const TaskOptions& options) {
  print(stdout, ending_text(summary, ending, options));
  std::string verdict = summary.fault ? "" : to_string(ending.verdict);
  if (!verdict.empty() && !ending.only.empty()) verdict = ending.only + ": " + verdict;
  const bool failed = options.strict && !verdict.empty() && !ending.verdict.missed.empty();
  if (summary.fault) print(stderr, error_line(*summary.fault, options.session) + "\n");
  if (failed)
    print(stderr, FaultError(FaultCode::figures_missed, verdict).error_line(options.session) + "\n");
  if (!verdict.empty()) print(stdout, fmt::format("done; {}\n", verdict));
  print(stdout, fmt::format("run folder: {}\n", ending.folder.string()));
  if (failed) return exit_status(FaultCode::figures_missed);
  return summary.fault ? exit_status(summary.fault->code) : 0;
}

}  // namespace mrroc::mp
