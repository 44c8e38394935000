// Two platforms push a box to a pose.
#include <fmt/format.h>

#include <numbers>

#include "ecp/map/config.hpp"
#include "launch/task.hpp"
#include "tasks/box_push/box_run.hpp"
#include "tasks/box_push/config.hpp"
#include "tasks/box_push/figures.hpp"
#include "tasks/box_push/keys.hpp"
#include "tasks/box_push/options.hpp"
#include "tasks/box_push/plots.hpp"

namespace {

using namespace mrroc;

std::vector<launch::CellPlatform> platforms() {
  return {{box_push::kKeys[0], "rex"}, {box_push::kKeys[1], "rex"}};
}

void prepare(const launch::Setup& s) {
  std::ignore = box_push::read_coordinator(s.config);
  std::ignore = box_push::read_pusher(s.config);
  std::ignore = ecp::read_map(s.config);
}

std::string words(const launch::Setup& s) {
  const PlanarPose goal = box_push::read_coordinator(s.config).goal;
  return fmt::format("the box to ({:g}, {:g}), {:.3g} degrees", goal.x, goal.y,
                     goal.phi * 180 / std::numbers::pi);
}

std::vector<mp::NodeSpec> map_nodes(const launch::Setup& s) {
  std::vector<mp::NodeSpec> nodes;
  for (std::size_t k = 0; k < box_push::kPlatforms; ++k) {
    const launch::CellArm platform{box_push::kKeys[k], "rex"};
    nodes.push_back(launch::make_node(s.config, std::string("ecp-") + box_push::kMaps[k], "ecp_box_push_map",
                                      &platform, box_push::run_map));
  }
  return nodes;
}

std::unique_ptr<mp::CoordinatorRun> make_coordinator(mp::TaskRun& run, const launch::Setup& s) {
  return std::make_unique<box_push::BoxRun>(
      run, box_push::BoxRunParameters{.coordinator = box_push::read_coordinator(s.config),
                                      .capture = read_motion_capture(s.config),
                                      .gives_start = s.options.scripted(),
                                      .records = s.options.check.empty()});
}

void make_results(launch::Results& r) {
  const box_push::PushResults results = r.coordinator_as<box_push::BoxRun>().results();
  box_push::write_push_table(r.folder / "box.csv", results.table, results.k.goal, results.macrostep);
  r.add(box_push::figures_of(results), box_push::kFigures);
  if (!results.table.empty()) r.pictures = box_push::plots(results);
}

}  // namespace

int main(int argc, char** argv) {
  box_push::PushOptions options;
  return launch::run_task(
      {.name = "box_push",
       .about = "Two skid-steering platforms push a box, which is too heavy for one of them, to a pose.",
       .config = box_push::config(),
       .platforms = platforms(),
       .ecp = box_push::run_ecp,
       .options = [&](CommandLine& line) { box_push::add_push_options(line, options); },
       .examples = {"./run box_push --to 1.5 0.5 30", "./run box_push --box 0.5 0 90 --to -1 1 180"},
       .instead_of_config = {"--to", "--box"},
       .found = [&](mp::TaskOptions&) { return box_push::settings_of(options); },
       .typed = box_push::options_of_keys(),
       .prepare = prepare,
       .words = words,
       .nodes = map_nodes,
       .coordinator = make_coordinator,
       .results = make_results},
      argc, argv);
}
