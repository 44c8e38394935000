// The drawing task: two arms copy a drawing that is taught to one of them.
#include "launch/task.hpp"
#include "tasks/drawing/belt_figures.hpp"
#include "tasks/drawing/cell/paper.hpp"
#include "tasks/drawing/conveyor.hpp"
#include "tasks/drawing/drawing_run.hpp"
#include "tasks/drawing/ecp_body.hpp"
#include "tasks/drawing/figure_info.hpp"
#include "tasks/drawing/plots.hpp"
#include "tasks/drawing/results.hpp"
#include "tasks/drawing/run_setup.hpp"
#include "vsp/pen_state/config.hpp"

namespace {

using namespace mrroc;

const std::vector<launch::CellArm> kArms{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};
const launch::CellArm kConveyor{drawing::kConveyorKey, "conveyor"};

/// Data that the parts of a run share.
struct Drawing {
  drawing::InputOptions options;
  drawing::ConveyorOptions conveyor;
  drawing::RunSetup setup;
};

void prepare(Drawing& d, const launch::Setup& s) {
  d.setup = drawing::read_setup(d.options, s.config, s.options.check, s.options.scripted());
  vsp::read_pen_state(s.config);
}

std::vector<mp::NodeSpec> pen_sensors(const launch::Setup& s) {
  std::vector<mp::NodeSpec> nodes;
  for (const launch::CellArm& arm : kArms)
    nodes.push_back(launch::make_node(s.config, "vsp-" + arm.key, "vsp_pen_state", &arm, vsp::run_pen_state));
  return nodes;
}

void make_results(const Drawing& d, launch::Results& r) {
  const auto& [input, k, plan] = d.setup;
  const drawing::RunRecord& record = r.coordinator_as<drawing::DrawingRun>().record();
  const auto ink = drawing::collect_ink(r.folder, launch::keys_of(kArms), input.taught_ink());
  drawing::write_tables(r.folder, ink);
  const auto papers = drawing::paper_places(r.setup.config);
  auto figures = drawing::figures_of(input.drawing, !input.taught, record, ink, k, !r.summary.fault);
  figures.merge(drawing::belt_figures(record, ink, k, papers, !r.summary.fault));
  r.add(figures, drawing::kFigures);
  r.columns.assign(drawing::kFigureColumns.begin(), drawing::kFigureColumns.end());
  r.remarks = drawing::warnings(r.summary);
  if (!d.options.save.empty()) drawing::save_taught(d.options.save, record, ink);
  r.pictures = drawing::plots(r.folder, {papers});
}

}  // namespace

int main(int argc, char** argv) {
  Drawing d;
  return launch::run_task(
      {.name = "drawing",
       .about = "Two simulated IRb-6 arms copy a drawing that an operator teaches to one of them by leading "
                "its pen.\n"
                "Without options the built-in arrow with six feathers is taught and copied.",
       .config = drawing::default_config(),
       .arms = kArms,
       .more_arms =
           [](const Config& config) {
             return drawing::has_conveyor(config) ? std::vector{kConveyor} : std::vector<launch::CellArm>{};
           },
       .ecp = drawing::run_drawing_ecp,
       .options =
           [&](CommandLine& line) {
             drawing::add_input_options(line, d.options);
             drawing::add_conveyor_options(line, d.conveyor);
           },
       .examples = {"./run drawing --drawing my.svg --size 150", "./run drawing --load arrow.taught",
                    "./run drawing --conveyor", "./run drawing --belt-speed 0.1",
                    "./run drawing --save arrow.taught"},
       .found = [&](mp::TaskOptions&) { return drawing::conveyor_settings(d.conveyor); },
       .typed = {{"task.belt_speed", "--belt-speed"}},
       .prepare = [&](const launch::Setup& s) { prepare(d, s); },
       .words = [&](const launch::Setup&) { return d.setup.input.about(); },
       .unattended = ", unattended: the scripted operator gives start and triggers",
       .strokes = drawing::kInputFile,
       .files = [&](const std::filesystem::path& folder) { drawing::write_input(folder, d.setup.input); },
       .nodes = pen_sensors,
       .coordinator =
           [&](mp::TaskRun& run, const launch::Setup& s) {
             return std::make_unique<drawing::DrawingRun>(run, launch::keys_of(s.arms), d.setup.k,
                                                          d.setup.plan, d.setup.input.recording());
           },
       .results = [&](launch::Results& r) { make_results(d, r); }},
      argc, argv);
}
