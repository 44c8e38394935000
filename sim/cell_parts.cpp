#include "sim/cell_parts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <tuple>

#include "base/link/lossy_bus.hpp"
#include "base/link/session.hpp"
#include "mp/hosts.hpp"
#include "mp/operator_desk.hpp"
#include "robots/irb6/config.hpp"
#include "robots/irb6/edp_body.hpp"
#include "sim/camera/config.hpp"
#include "sim/config.hpp"

namespace mrroc::sim {

WorldParameters read_cell(const Config& config, const std::vector<CellArm>& arms, std::uint64_t seed) {
  std::vector<std::string> keys;
  for (const CellArm& arm : arms) keys.push_back(arm.key);
  WorldParameters parameters = read_world(config);
  if (config.texts("robots.order", keys) != keys)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("robots.order: this task has the arms {}, in this order", fmt::join(keys, ", ")));
  read_camera_world(config, keys);
  const World still(parameters, seed);
  for (std::size_t k = 0; k < arms.size(); ++k) {
    const AxisVector joints = still.start_joints(static_cast<int>(k));
    irb6::read_driver(config, arms[k].key, arms[k].model, {joints.begin(), joints.end()});
    irb6::read_tool(config, arms[k].key, arms[k].model);
    irb6::read_command_link(config, arms[k].key);
    irb6::read_recording(config, arms[k].key);
  }
  return parameters;
}

Config load_task_config(const mp::TaskOptions& options, std::string_view built_in, const std::string& task) {
  if (!options.check.empty()) return Config::load((options.check / "config.toml").string());
  Config config = options.config_file.empty() ? Config::parse(built_in, task + ".toml (built in)")
                                              : Config::load(options.config_file);
  for (const std::string& s : options.settings) config.set(s);
  config.set(fmt::format("seed={}", options.seed));
  mp::read_hosts(config);  // who starts the processes reads them again
  link::read_loss(config);
  return config;
}

void check_task_options(const mp::TaskOptions& o) {
  if (!o.session.empty()) link::check_session_name(o.session);
  if (!o.script.empty()) mp::load_script(o.script);
  if (o.url.empty()) return;
  try {
    std::ignore = link::LcmAddress::parse(o.url);
  } catch (const std::invalid_argument& e) {
    throw FaultError(FaultCode::bad_usage, e.what());
  }
}

void complete_config(const Config& c, const mp::TaskOptions& o, const std::filesystem::path& folder,
                     const std::string& strokes) {
  std::ignore = c.integer<std::int64_t>("seed", 1);
  std::ignore = c.number("sim.speed", o.speed, {0, 1e4}, "of real time, 0: as fast as possible");
  std::ignore = c.text("run.folder", std::filesystem::absolute(folder).string());
  std::ignore = c.text("run.strokes", strokes);
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
  for (const CellArm& arm : arms)
    parts.push_back(make_part(config, "edp-" + arm.key, "edp_irb6", &arm, irb6::run_edp_of_arm));
  return parts;
}

}  // namespace mrroc::sim
