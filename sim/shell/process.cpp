#include "sim/shell/process.hpp"

#include <optional>
#include <string>

#include "robots/hardware_kind.hpp"
#include "sim/config.hpp"
#include "sim/shell/shell.hpp"
#include "sim/strokes_file.hpp"

namespace mrroc::sim {

void run_simulator_process(link::Process& process, const Config& config, const link::NodeArguments&) {
  process.needs_unlogged("the servo links");
  ShellParameters shell;
  shell.robots = config.texts("robots.order", std::nullopt);
  for (const std::string& robot : shell.robots) {
    const bool simulated = robots::read_hardware(config, robot).simulated();
    shell.drivers.push_back(simulated ? "edp-" + robot : "");
  }
  shell.speed = config.number("sim.speed", std::nullopt, {0, 1e4}, "of real time, 0: as fast as possible");
  shell.folder = config.text("run.folder", std::nullopt);
  if (const std::string strokes = config.text("run.strokes", std::nullopt); !strokes.empty())
    shell.strokes = read_strokes(strokes);
  const WorldParameters parameters = read_world(config);
  World world(parameters, static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1)));
  const CameraWorld seen = read_camera_world(config, shell.robots);
  std::optional<CameraStation> cameras;
  if (!seen.cameras.empty()) cameras.emplace(process, seen, parameters, shell.robots);
  run_simulator(process, world, shell, cameras ? &*cameras : nullptr);
}

}  // namespace mrroc::sim
