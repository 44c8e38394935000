// Two arms find where they stand to each other, and what their tools weigh.
#include <fmt/core.h>

#include <tuple>

#include "launch/arm_task.hpp"
#include "mp/run_folder.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"
#include "tasks/calibrate_cell/cell/kinematic_sets.hpp"
#include "tasks/calibrate_cell/plots.hpp"
#include "tasks/calibrate_cell/result.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"

namespace {

using namespace mrroc;
using namespace mrroc::calibrate_cell;

mp::TaskFigures figures_of(const std::vector<mp::ArmTrace>& traces, const Config& config) {
  const SetsVerdict verdict = fit_sets(traces, config);
  mp::TaskFigures all =
      figures(traces, verdict.fits[verdict.chosen].found, believed_bases(config), true_bases(config));
  add_figures(all, verdict, true_sets(config));
  return all;
}

std::vector<launch::Picture> pictures(const std::vector<mp::ArmTrace>& traces, const Config& config) {
  const SetsVerdict verdict = fit_sets(traces, config);
  const auto& found = verdict.fits[verdict.chosen].found;
  if (!found) return {};
  return {{.name = "balls", .script = balls_script(*found, believed_bases(config))}};
}

/// Writes the file that other tasks take.
void write_result(launch::Results& r) {
  if (r.summary.fault || r.summary.stopped) return;
  const Config& config = r.setup.config;
  const std::vector<mp::ArmTrace> traces(r.coordinator.traces().begin(), r.coordinator.traces().end());
  const SetsVerdict verdict = fit_sets(traces, config);
  const SetsFit& chosen = verdict.fits[verdict.chosen];
  if (!chosen.found) throw FaultError(kTouchesDoNotFit, "the balls leave open how the bases stand");
  const auto file = r.folder / kResultFile;
  mp::write_text(file, as_toml(corrected(believed_bases(config), *chosen.found),
                               {tool_of(traces[0]), tool_of(traces[1])},
                               verdict.told_apart ? chosen.names : std::array<std::string, kArms>{},
                               r.folder.filename().string()));
  r.remarks =
      describe(verdict) + fmt::format("what was found, for the other tasks: --config {}\n", file.string());
}

}  // namespace

int main(int argc, char** argv) {
  launch::Task task = launch::task_of(
      {.name = "calibrate_cell",
       .about = "Two arms weigh their tools and touch the same balls; that tells where their bases stand to "
                "each other.\n"
                "It leaves calibrated.toml in the run folder, which other tasks take with --config.",
       .config = config(),
       .behaviours = launch::words_of(kBehaviours),
       .ecp = run_ecp,
       .read =
           [](const Config& config) {
             check_reach(config);
             for (const char* arm : kKeys) std::ignore = read_memory(config, arm);
           },
       .figures = figures_of,
       .pictures = pictures,
       .coordinate = take_turns,
       .arms = {{kKeys[0], "irb6_postument"}, {kKeys[1], "irb6_track"}}});
  task.complete = [](Config& config, const mp::TaskOptions&) { complete(config); };
  task.results = [evaluate = task.results](launch::Results& r) {
    evaluate(r);
    write_result(r);
  };
  return launch::run_task(task, argc, argv);
}
