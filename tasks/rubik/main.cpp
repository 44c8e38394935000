// The task of the cube: two arms read a scrambled cube, find a solution and turn its faces until it is solved.
#include "launch/task.hpp"
#include "launch/task_config.hpp"
#include "tasks/rubik/cell/cell_settings.hpp"
#include "tasks/rubik/cell/planning_context.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/figure_info.hpp"
#include "tasks/rubik/options.hpp"
#include "tasks/rubik/plots.hpp"
#include "tasks/rubik/results.hpp"
#include "vsp/cube_face/receptor.hpp"

namespace {

using namespace mrroc;

/// Data that the parts of a run share.
struct Rubik {
  rubik::CubeOptions options;
  rubik::RunSetup setup;
  std::optional<rubik::PlanningContext> planning;
};

std::vector<std::string> find_out(const Rubik& r, mp::TaskOptions& task) {
  if (r.options.eyes && launch::is_of_run(task))
    throw FaultError(FaultCode::bad_usage, "--eyes: the configuration of a run says whether it has a camera",
                     "leave out --eyes");
  const std::vector<std::string> cube = rubik::cube_settings(r.options);
  task.settings.insert(task.settings.begin(), cube.begin(), cube.end());
  return rubik::cell_settings(r.options.eyes.value_or("camera") == "camera");
}

void prepare(Rubik& r, const launch::Setup& s) {
  r.setup = rubik::read_setup(s.config);
  if (r.setup.camera) vsp::make_cube_face_sensor(s.config, r.setup.camera->key);
  if (!s.options.parameters) r.planning.emplace(r.setup);
}

std::unique_ptr<mp::CoordinatorRun> make_coordinator(Rubik& r, mp::TaskRun& run, const launch::Setup& s) {
  rubik::PlannerServices services = r.planning->services();
  services.aside = s.options.check.empty();
  return std::make_unique<rubik::RubikRun>(run, r.setup.k, std::move(services), s.options.scripted());
}

void make_results(launch::Results& r) {
  const auto& run = r.coordinator_as<rubik::RubikRun>();
  r.add(rubik::write_results(r.folder, run.record(), run.truth()), rubik::kFigures);
  r.pictures = rubik::plots(run.record());
}

}  // namespace

int main(int argc, char** argv) {
  Rubik r;
  return launch::run_task(
      {.name = "rubik",
       .about = "Two simulated IRb-6 arms solve a Rubik's cube: one holds it, the other one turns its faces.",
       .config = rubik::config(),
       .arms = {{rubik::kArmKeys[0], std::string(rubik::kArmModels[0])},
                {rubik::kArmKeys[1], std::string(rubik::kArmModels[1])}},
       .ecp = rubik::run_ecp,
       .options = [&](CommandLine& line) { rubik::add_cube_options(line, r.options); },
       .examples = {"./run rubik --scramble \"R U'\""},
       .found = [&](mp::TaskOptions& task) { return find_out(r, task); },
       .complete = [](Config& config, const mp::TaskOptions&) { rubik::complete_cube(config); },
       .prepare = [&](const launch::Setup& s) { prepare(r, s); },
       .nodes =
           [&](const launch::Setup& s) {
             return r.setup.camera ? launch::camera_nodes(s.config, {r.setup.camera->key}, "vsp_cube_face",
                                                          vsp::run_cube_face)
                                   : std::vector<mp::NodeSpec>{};
           },
       .coordinator = [&](mp::TaskRun& run, const launch::Setup& s) { return make_coordinator(r, run, s); },
       .results = make_results},
      argc, argv);
}
