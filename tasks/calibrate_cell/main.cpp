// Two arms find where they stand to each other, where the cameras are, and what their tools weigh.
#include <fmt/core.h>

#include <tuple>

#include "launch/arm_task.hpp"
#include "mp/run_folder.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/cell/cell.hpp"
#include "tasks/calibrate_cell/cell/findings.hpp"
#include "tasks/calibrate_cell/cell_run.hpp"
#include "tasks/calibrate_cell/plots.hpp"
#include "vsp/image_receptor.hpp"

namespace {

using namespace mrroc;
using namespace mrroc::calibrate_cell;

std::vector<CameraSetup> cameras(const Config& config) {
  std::vector<CameraSetup> all;
  for (const std::string& key : camera_keys(config)) all.push_back(read_camera(config, key));
  return all;
}

/// Reads what the parts of a run will read.
void read_all(const Config& config) {
  const std::vector<mp::ArmTrace> nothing(kArms);
  check_reach(config);
  for (const char* arm : kKeys) std::ignore = read_memory(config, arm);
  for (const CameraSetup& camera : cameras(config)) vsp::chessboard_receptor().make(camera.model, config);
  std::ignore = figures_of(find_all(nothing, {}, config), nothing, config);
}

std::vector<launch::Picture> pictures(const Findings& f, const Config& config) {
  if (!f.by_touch()) return {};
  const auto& found = f.touched->fits[f.touched->chosen].found;
  return {{.name = "balls", .script = balls_script(*found, believed_bases(config))}};
}

/// Writes the file that other tasks take.
void write_result(const Findings& f, const std::vector<mp::ArmTrace>& traces, launch::Results& r) {
  if (r.summary.fault || r.summary.stopped) return;
  const auto file = r.folder / kResultFile;
  mp::write_text(file, as_toml(result_of(f, traces, r.setup.config), r.folder.filename().string()));
  r.remarks = (f.touched ? describe(*f.touched) : "") + describe_ways(f) +
              fmt::format("what was found, for the other tasks: --config {}\n", file.string());
}

void make_results(launch::Results& r) {
  const auto& run = r.coordinator_as<CellRun>();
  const std::vector<mp::ArmTrace> traces(run.traces().begin(), run.traces().end());
  const Findings f = find_all(traces, run.records(), r.setup.config);
  launch::evaluate(
      {.behaviours = launch::words_of(kBehaviours),
       .figures = [&](const auto& rows, const Config& config) { return figures_of(f, rows, config); },
       .pictures = [&](const auto&, const Config& config) { return pictures(f, config); }},
      r);
  write_result(f, traces, r);
}

mp::SoloParameters solo_parameters(const launch::Setup& s) {
  mp::SoloParameters k{.arms = launch::keys_of(s.arms), .behaviours = launch::words_of(kBehaviours)};
  k.dt = s.config.number("time.dt", k.dt, {0.002, 0.002}, "s");
  k.n_s = s.config.integer("time.n_s", k.n_s, {k.n_s, k.n_s}, "steps");
  k.coordinate = take_turns;
  k.gives_start = s.options.scripted();
  return k;
}

}  // namespace

int main(int argc, char** argv) {
  return launch::run_task(
      {.name = "calibrate_cell",
       .about =
           "Two arms weigh their tools, show a board to cameras and touch the same balls; that tells where "
           "their bases\n"
           "stand to each other, and where the cameras are. It leaves calibrated.toml in the run folder, "
           "which other tasks\ntake with --config.",
       .config = config(),
       .arms = {{kKeys[0], kModels[0]}, {kKeys[1], kModels[1]}},
       .ecp = run_ecp,
       .complete = [](Config& config, const mp::TaskOptions&) { complete(config); },
       .prepare =
           [](const launch::Setup& s) {
             std::ignore = solo_parameters(s);
             read_all(s.config);
           },
       .nodes =
           [](const launch::Setup& s) {
             const vsp::ImageReceptor& receptor = vsp::chessboard_receptor();
             return launch::camera_nodes(s.config, camera_keys(s.config), receptor.program,
                                         vsp::body_of(receptor));
           },
       .coordinator =
           [](mp::TaskRun& run, const launch::Setup& s) {
             return std::make_unique<CellRun>(run, cameras(s.config), solo_parameters(s));
           },
       .results = make_results},
      argc, argv);
}
