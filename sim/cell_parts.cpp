#include "sim/cell_parts.hpp"

#include <fmt/core.h>

#include <array>
#include <tuple>

#include "base/config_store.hpp"
#include "base/joined.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/session.hpp"
#include "mp/hosts.hpp"
#include "mp/operator_desk.hpp"
#include "robots/catalogue.hpp"
#include "robots/irb6/config.hpp"
#include "robots/irb6/edp_body.hpp"
#include "sim/camera/config.hpp"
#include "sim/config.hpp"

namespace mrroc::sim {
namespace {

/// What kind of robot an arm is; null: an IRb-6.
const robots::Kind* kind_of(const Config& config, const CellArm& arm) {
  return robots::find(config.section("robots." + arm.key).text("model", arm.model));
}

/// Reads what the driver of an arm and the task's preparation will read. @param joints  where it stands
void read_arm(const Config& config, const CellArm& arm, const std::vector<double>& joints) {
  if (const robots::Kind* const kind = kind_of(config, arm)) {
    robots::read_driver(config, arm.key, *kind->make(), kind->driver, joints);
    robots::read_tool(config, arm.key, kind->driver);
  } else {
    irb6::read_driver(config, arm.key, arm.model, joints);
    irb6::read_tool(config, arm.key, arm.model);
  }
  robots::read_command_link(config, arm.key);
  robots::read_recording(config, arm.key);
}

constexpr IntegerBounds kSeeds{.min = 0};

/// @throws FaultError  for keys that only options give
void refuse_keys_of_options(const std::vector<std::string>& settings) {
  constexpr std::array<std::array<const char*, 2>, 3> kKeys{
      {{"sim.speed", "--speed"}, {"run.folder", "--run-dir"}, {"run.strokes", "--drawing"}}};
  for (const std::string& setting : settings)
    for (const auto& [key, option] : kKeys)
      if (setting.starts_with(std::string(key) + "="))
        throw FaultError(FaultCode::bad_usage, fmt::format("{} cannot be set", key),
                         fmt::format("give {}", option));
}

/// Gives a key a text that may hold anything.
void set_text(Config& config, std::string_view key, const std::string& text) {
  config.set(fmt::format("{}={}", key, to_toml(text)));
}

Config load_below_settings(const mp::TaskOptions& options, std::string_view built_in, const std::string& task,
                           const std::vector<std::string>& found) {
  const Config given = options.config_file.empty() ? Config() : Config::load(options.config_file);
  if (given.has("run.folder") && given.has("robots.order")) {  // of a run: it has everything
    Config config = given;
    const std::string folder = config.text("run.folder", Config::kRequired);
    if (config.has("film.directory") && config.text("film.directory", "") == folder)
      set_text(config, "film.directory", "");
    return config;
  }
  Config config = Config::parse(built_in, task + ".toml (built in)");
  for (const std::string& s : found) config.set(s);
  config.overlay(given);
  return config;
}

}  // namespace

WorldParameters read_cell(const Config& config, const std::vector<CellArm>& arms, std::uint64_t seed) {
  std::vector<std::string> keys;
  for (const CellArm& arm : arms) keys.push_back(arm.key);
  WorldParameters parameters = read_world(config);
  if (config.texts("robots.order", keys) != keys)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("robots.order: this task has the arms {}, in this order", joined(keys, ", ")));
  read_camera_world(config, keys);
  const World still(parameters, seed);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const AxisVector& joints = still.start_joints(static_cast<int>(k));
    read_arm(config, arms[k], {joints.begin(), joints.end()});
  }
  return parameters;
}

Config load_task_config(const mp::TaskOptions& options, std::string_view built_in, const std::string& task,
                        const std::vector<std::string>& found) {
  refuse_keys_of_options(options.settings);
  const bool checks = !options.check.empty();
  Config config = checks ? Config::load((options.check / "config.toml").string())
                         : load_below_settings(options, built_in, task, found);
  if (!checks) {
    for (const std::string& s : options.settings) config.set(s);
    if (options.seed_asked) config.set(fmt::format("seed={}", options.seed));
  }
  if (checks) return config;
  mp::read_hosts(config);  // who starts the processes reads them again
  link::read_loss(config);
  return config;
}

std::uint64_t seed_of(const Config& config) {
  return static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1, kSeeds));
}

void check_task_options(const mp::TaskOptions& o) {
  if (!o.session.empty()) link::check_session_name(o.session);
  if (o.clock == ClockKind::wall && o.speed_asked && o.speed != 1)
    throw FaultError(FaultCode::bad_usage, "--speed is for lock-step: with --clock wall a second is a second",
                     "leave out --speed, or --clock wall");
  if (!o.script.empty()) mp::load_script(o.script);
  if (o.url.empty()) return;
  try {
    std::ignore = link::LcmAddress::parse(o.url);
  } catch (const std::invalid_argument& e) {
    throw FaultError(FaultCode::bad_usage, e.what());
  }
}

void complete_config(Config& c, const mp::TaskOptions& o, const std::filesystem::path& folder,
                     const std::string& strokes, bool film) {
  const std::string there = std::filesystem::absolute(folder).string();
  if (film && (!c.has("film.directory") || c.text("film.directory", "").empty()))
    set_text(c, "film.directory", there);
  std::ignore = c.text("film.directory", "");
  c.set(fmt::format("sim.speed={}", o.speed));
  set_text(c, "run.folder", there);
  set_text(c, "run.strokes", strokes);
  std::ignore = c.number("sim.speed", Config::kRequired, {0, 1e4}, "of real time, 0: as fast as possible");
  for (const char* key : {"run.folder", "run.strokes"}) std::ignore = c.text(key, Config::kRequired);
  c.check_all_used();
}

mp::Part make_part(const Config& config, const std::string& name, const std::string& program,
                   const CellArm* arm, const link::PartBody& body) {
  mp::Part p{name, program, {"--name", name}, {}};
  const std::string key = arm ? arm->key : "";
  if (arm) p.arguments.insert(p.arguments.end(), {"--arm", arm->key, "--robot", arm->model});
  p.body = [config = config.copy(), key, body](link::Process& process) { body(process, config, {key}); };
  return p;
}

std::vector<mp::Part> cell_parts(const Config& config, const std::vector<CellArm>& arms) {
  std::vector<mp::Part> parts{make_part(config, "world", "world", nullptr, run_world_process)};
  for (const CellArm& arm : arms) {
    if (const robots::Kind* const kind = kind_of(config, arm))
      parts.push_back(make_part(config, "edp-" + arm.key, "edp_" + std::string(kind->name), &arm,
                                robots::driver_of(*kind)));
    else
      parts.push_back(make_part(config, "edp-" + arm.key, "edp_irb6", &arm, irb6::run_edp_of_arm));
  }
  return parts;
}

}  // namespace mrroc::sim
