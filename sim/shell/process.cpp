#include "sim/shell/process.hpp"

#include <algorithm>
#include <optional>
#include <string>

#include "robots/hardware_kind.hpp"
#include "robots/platforms.hpp"
#include "sim/camera/cell_view.hpp"
#include "sim/camera/room_view.hpp"
#include "sim/config.hpp"
#include "sim/platform/config.hpp"
#include "sim/shell/shell.hpp"
#include "sim/strokes_file.hpp"

namespace mrroc::sim {

namespace {

ShellParameters read_shell(const Config& config) {
  ShellParameters shell;
  shell.robots = config.texts("robots.order", std::nullopt);
  for (const std::string& robot : shell.robots) {
    const bool simulated = robots::read_hardware(config, robot).simulated();
    shell.drivers.push_back(simulated ? "edp-" + robot : "");
  }
  // A task without platforms does not know the key.
  if (config.has("platforms.order")) shell.platforms = robots::read_platform_order(config);
  for (const std::string& platform : shell.platforms) shell.platform_drivers.push_back("edp-" + platform);
  shell.speed = config.number("sim.speed", std::nullopt, {0, 1e4}, "of real time, 0: as fast as possible");
  shell.folder = config.text("run.folder", std::nullopt);
  const std::filesystem::path strokes = config.text("run.strokes", std::nullopt);
  if (is_hand_track(strokes))
    shell.track = read_hand_track(strokes);
  else
    shell.strokes = read_strokes(strokes);
  return shell;
}

/// @return the cameras with what they look at: those on platforms, and those on the floor when there are no arms, at the
///         room, the others at the cell
std::vector<PlacedCamera> placed(const std::vector<SimulatedCamera>& cameras, const ShellParameters& shell,
                                 View* cell, View* room) {
  std::vector<PlacedCamera> all;
  for (const SimulatedCamera& each : cameras) {
    const bool on_platform = std::ranges::find(shell.platforms, each.setup.robot) != shell.platforms.end();
    all.push_back({each, on_platform || !cell ? room : cell});
  }
  return all;
}

}  // namespace

void run_simulator_process(link::Process& process, const Config& config, const link::NodeArguments&) {
  process.needs_unlogged("the servo links");
  ShellParameters shell = read_shell(config);
  const auto seed = static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1));
  const CameraWorld seen = read_camera_world(config, shell.robots, shell.platforms);
  std::optional<World> arms;
  std::optional<CellView> cell;
  if (!shell.robots.empty()) {
    const WorldParameters parameters = read_world(config);
    arms.emplace(parameters, seed);
    if (!seen.cameras.empty())
      cell.emplace(process, *arms, parameters, shell.robots, seen.light, seen.object);
  }
  std::optional<PlatformWorld> platforms;
  std::optional<RoomView> room;
  if (!shell.platforms.empty()) {
    const PlatformWorldParameters parameters =
        read_platform_world(config, shell.platforms, robots::platforms());
    platforms.emplace(parameters, seed);
    for (const BoxParameters& box : parameters.boxes) shell.boxes.push_back(box.name);
    if (!seen.cameras.empty()) room.emplace(*platforms, parameters, shell.platforms, seen.light, seen.look);
  }
  std::optional<CameraStation> cameras;
  if (!seen.cameras.empty())
    cameras.emplace(process, placed(seen.cameras, shell, cell ? &*cell : nullptr, room ? &*room : nullptr));
  run_simulator(process,
                {.arms = arms ? &*arms : nullptr,
                 .platforms = platforms ? &*platforms : nullptr,
                 .cameras = cameras ? &*cameras : nullptr},
                shell);
}

}  // namespace mrroc::sim
