// The visual servoing task: an arm brings its tool to a pose before an object that cameras see, and follows it.
#include <fmt/core.h>

#include "base/camera_config.hpp"
#include "launch/task.hpp"
#include "tasks/visual_servo/cell/tool_camera.hpp"
#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/figure_info.hpp"
#include "tasks/visual_servo/plots.hpp"
#include "tasks/visual_servo/program.hpp"
#include "tasks/visual_servo/scenario.hpp"
#include "tasks/visual_servo/servo_run.hpp"
#include "vsp/image_receptor.hpp"

namespace {

using namespace mrroc;

/// Receptors for the cameras' pictures.
const vsp::ImageReceptor& receptor_of(const Config& config) {
  const bool board = visual_servo::read_object(config) == visual_servo::Object::chessboard;
  return board ? vsp::chessboard_receptor() : vsp::apriltag_receptor();
}

void prepare(visual_servo::Parameters& k, const Config& config) {
  k = visual_servo::read_parameters(config);
  for (const std::string& key : camera_keys(config))
    receptor_of(config).make(read_camera_model(config, key), config);
}

void make_results(launch::Results& r) {
  const auto table =
      r.coordinator_as<visual_servo::ServoRun>().table(visual_servo::tool_camera_error(r.setup.config));
  visual_servo::write_servo_table(r.folder / "servo.csv", table);
  r.add(visual_servo::figures_of(table), visual_servo::kFigures);
  if (!table.empty()) r.pictures = visual_servo::plots(table);
}

}  // namespace

int main(int argc, char** argv) {
  visual_servo::ScenarioOptions scenario;
  visual_servo::Parameters k;
  return launch::run_task(
      {.name = "visual_servo",
       .about = "An arm brings its tool to a pose before an object and follows it when it moves; it sees the "
                "object\n"
                "through a camera above the scene (SAC), one in the hand (EIH), or both.",
       .config = visual_servo::config(),
       .arms = {{std::string(visual_servo::kArm), "irb6_postument"}},
       .ecp = visual_servo::run_ecp,
       .options = [&](CommandLine& line) { visual_servo::add_scenario_options(line, scenario); },
       .instead_of_config = {visual_servo::kScenarioOptions.begin(), visual_servo::kScenarioOptions.end()},
       .found = [&](mp::TaskOptions&) { return visual_servo::settings_of(scenario); },
       .complete =
           [](Config& config, const mp::TaskOptions& o) {
             if (o.clock == ClockKind::wall && o.check.empty()) visual_servo::believe_late_pictures(config);
           },
       .prepare = [&](const launch::Setup& s) { prepare(k, s.config); },
       .words =
           [&](const launch::Setup& s) {
             return s.options.config_file.empty()
                        ? fmt::format("scenario {}, {}", scenario.scenario, scenario.object)
                        : "as in " + s.options.config_file.string();
           },
       .nodes =
           [](const launch::Setup& s) {
             const vsp::ImageReceptor& receptor = receptor_of(s.config);
             return launch::camera_nodes(s.config, camera_keys(s.config), receptor.program,
                                         vsp::body_of(receptor));
           },
       .coordinator =
           [&](mp::TaskRun& run, const launch::Setup& s) {
             return std::make_unique<visual_servo::ServoRun>(run, k, s.options.scripted(),
                                                             s.options.check.empty());
           },
       .results = make_results},
      argc, argv);
}
