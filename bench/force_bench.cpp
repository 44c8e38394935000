// Force measurement and the tasks that are made of force control: identification, press, edge_follow.
#include "bench/force_bench.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/fault.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"
#include "test/rig/force_figures.hpp"

namespace mrroc::bench {
namespace {

/// Figures of a task that is run to its end; of those per arm the largest.
nlohmann::json figures_of(const std::string& task) {
  const ScratchFolder scratch;
  const auto folder = scratch.path() / task;
  TaskProcess process(task, {"--processes", "one", "--seed", "1", "--run-dir", folder.string()});
  if (process.wait() != 0)
    throw FaultError(FaultCode::internal_error, "the task " + task + " did not end well");
  return needed_summary(folder).at("figures");
}

}  // namespace

Figures run_force_figures() {
  const rig::ForceFigures f = rig::measure_forces(20, 100, 1);
  const nlohmann::json press = figures_of("press");
  const nlohmann::json edge = figures_of("edge_follow");
  const double rms = std::ranges::max(edge.at("edge_follow_rms_N").get<std::vector<double>>());
  return {
      {"identified_weight_pct", f.weight_pct, "%",
       "error of the identified weight, largest of 20 random tools"},
      {"identified_centre_mm", f.centre_mm, "mm", "error of the identified mass centre, largest of the same"},
      {"free_force_N", f.free_force_N, "N", "F_a without contact, mean over 100 random orientations"},
      {"free_torque_Nm", f.free_torque_Nm, "N m", "the same, moments"},
      {"approach_settled_N", press.at("approach_settled_N").get<double>(), "N", "press: end of the approach"},
      {"approach_peak_N", press.at("approach_peak_N").get<double>(), "N", "press: impact"},
      {"edge_follow_rms_N", rms, "N", "edge_follow: force error at 4 N, worse of rectangle and ellipse"},
  };
}

}  // namespace mrroc::bench
