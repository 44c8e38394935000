// The platform's task: a skid-steering platform drives through the points of plans.
#include <fmt/format.h>

#include "base/counted.hpp"
#include "base/room_config.hpp"
#include "ecp/map/config.hpp"
#include "launch/task.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/figure_notes.hpp"
#include "tasks/rex_drive/figures.hpp"
#include "tasks/rex_drive/keys.hpp"
#include "tasks/rex_drive/options.hpp"
#include "tasks/rex_drive/plots.hpp"
#include "tasks/rex_drive/rex_run.hpp"
#include "vsp/odometry/config.hpp"
#include "vsp/odometry/receptor.hpp"

namespace {

using namespace mrroc;

/// Data that the parts of a run share.
struct Drive {
  rex_drive::DriveOptions options;
  rex_drive::PlanList plans;
  rex_drive::Itinerary itinerary;
};

/// A check drives what its run drove.
rex_drive::PlanList plans_of(const Config& config, const mp::TaskOptions& options) {
  if (options.check.empty()) return rex_drive::read_plan_list(config);
  return rex_drive::load_plans(options.check / rex_drive::kPlanFile);
}

void complete(Drive& d, Config& config, const mp::TaskOptions& options) {
  d.plans = plans_of(config, options);
  rex_drive::complete_drive(config, d.options, d.plans);
}

void prepare(Drive& d, const launch::Setup& s) {
  std::ignore = rex_drive::read_parameters(s.config);
  std::ignore = rex_drive::read_ontology(s.config);
  std::ignore = ecp::read_map(s.config);
  if (rex_drive::read_eyes(s.config)) std::ignore = vsp::read_stereo(s.config, rex_drive::kPlatform).rig();
  d.itinerary = rex_drive::examine(d.plans, s.config);
}

std::string words(const Drive& d) {
  return fmt::format("{}: {} in {}, planned to take {:.0f} s", d.plans.name,
                     counted(d.plans.points(), "point"), counted(d.plans.plans.size(), "plan"),
                     d.itinerary.survey.duration);
}

std::unique_ptr<mp::CoordinatorRun> make_coordinator(const Drive& d, mp::TaskRun& run,
                                                     const launch::Setup& s) {
  rex_drive::RexRunParameters k;
  k.ontology = rex_drive::read_ontology(s.config);
  k.lost = rex_drive::read_parameters(s.config).lost;
  k.plans = d.itinerary.plans;
  for (const auto& [plan, t] : d.itinerary.survey.found) k.iterations.push_back(t.iterations);
  k.gives_start = s.options.scripted();
  k.records = s.options.check.empty();
  k.eyes = rex_drive::read_eyes(s.config);
  return std::make_unique<rex_drive::RexRun>(run, std::move(k));
}

std::vector<launch::CellPlatform> platforms() { return {{rex_drive::kPlatform, "rex"}}; }

void make_results(launch::Results& r) {
  rex_drive::DriveResults results = r.coordinator_as<rex_drive::RexRun>().results(r.folder);
  results.room = read_room(r.setup.config);
  results.ground = read_ground(r.setup.config);
  rex_drive::write_drive_table(r.folder / "platform.csv", results.table);
  rex_drive::write_fragment_table(r.folder / "fragments.csv", results.fragments, results.table);
  if (!results.odometry.empty()) rex_drive::write_odometry_table(r.folder / "odometry.csv", results.odometry);
  const auto read = [](const Config& config) { launch::check_cell(config, {}, platforms()); };
  const auto read_all = [&read](const Config& config) {
    read(config);
    std::ignore = vsp::read_stereo(config, rex_drive::kPlatform);
  };
  const rex_drive::DriveCase drive = rex_drive::drive_case(r.setup.config, read);
  const rex_drive::FigureContext context{.smooth = results.ground.smooth,
                                         .eyes = rex_drive::changed_eyes(r.setup.config, read_all)};
  const mp::Figures figures = rex_drive::figures_of(results);
  r.add(figures, rex_drive::figures_of_run(drive, figures, context));
  r.remarks = rex_drive::figure_notes(figures, context);
  r.only = rex_drive::wanted_only(drive);
  if (!results.table.empty()) r.pictures = rex_drive::plots(results);
}

}  // namespace

int main(int argc, char** argv) {
  Drive d;
  return launch::run_task(
      {.name = "rex_drive",
       .about = "A skid-steering platform drives through the points of plans, estimating its state and the "
                "slip of\n"
                "its wheels.",
       .config = rex_drive::config(),
       .platforms = platforms(),
       .ecp = rex_drive::run_ecp,
       .options = [&](CommandLine& line) { rex_drive::add_drive_options(line, d.options); },
       .examples = {"./run rex_drive --plan slalom", "./run rex_drive --plan my_points.txt --speed-mps 0.4",
                    "./run rex_drive --ground slippery --tracker kinematic"},
       .instead_of_config = {"--plan", "--speed-mps", "--tracker", "--estimator", "--ground", "--eyes"},
       .found = [&](mp::TaskOptions&) { return rex_drive::settings_of(d.options); },
       .typed = rex_drive::options_of_keys(),
       .complete = [&](Config& config, const mp::TaskOptions& o) { complete(d, config, o); },
       .prepare = [&](const launch::Setup& s) { prepare(d, s); },
       .words = [&](const launch::Setup&) { return words(d); },
       .files =
           [&](const std::filesystem::path& folder) {
             mp::write_text(folder / rex_drive::kPlanFile, rex_drive::to_text(d.plans));
           },
       .nodes =
           [](const launch::Setup& s) {
             const Config& config = s.config;
             std::vector<mp::NodeSpec> nodes{launch::make_node(config, std::string("ecp-") + rex_drive::kMap,
                                                               "ecp_rex_drive_map", nullptr,
                                                               rex_drive::run_map)};
             if (rex_drive::read_eyes(config))
               nodes.push_back(launch::make_node(config, std::string("vsp-odometry-") + rex_drive::kPlatform,
                                                 "vsp_odometry", nullptr, vsp::run_odometry));
             return nodes;
           },
       .coordinator = [&](mp::TaskRun& run, const launch::Setup& s) { return make_coordinator(d, run, s); },
       .results = make_results},
      argc, argv);
}
