#include "launch/task_config.hpp"

#include <fmt/core.h>

#include <array>
#include <tuple>

#include "base/config_store.hpp"
#include "base/fault.hpp"
#include "base/link/event_log.hpp"
#include "base/link/lossy_bus.hpp"
#include "base/link/session.hpp"
#include "launch/calibrated.hpp"
#include "mp/hosts.hpp"
#include "mp/operator_command_server.hpp"

namespace mrroc::launch {
namespace {

constexpr IntegerBounds kSeeds{.min = 0};

/// @throws FaultError  for keys that only options or the task give
void refuse_keys_of_options(const std::vector<std::string>& settings) {
  constexpr std::array<std::array<const char*, 2>, 3> kKeys{
      {{"sim.speed", "give --speed"},
       {"run.folder", "give --run-dir"},
       {"run.strokes", "leave it out: the task gives it"}}};
  for (const std::string& setting : settings)
    for (const auto& [key, instead] : kKeys)
      if (setting.starts_with(std::string(key) + "="))
        throw FaultError(FaultCode::bad_usage, fmt::format("{} cannot be set", key), instead);
}

/// Gives a key a text that may hold anything.
void set_text(Config& config, std::string_view key, const std::string& text) {
  config.set(fmt::format("{}={}", key, to_toml(text)));
}

/// @return the configuration file of the options, or nothing
Config load_given(const mp::TaskOptions& options) {
  return options.config_file.empty() ? Config() : Config::load(options.config_file);
}

bool has_everything(const Config& given) { return given.has("run.folder") && given.has("robots.order"); }

Config load_below_settings(const mp::TaskOptions& options, std::string_view built_in, const std::string& task,
                           const std::vector<std::string>& found) {
  const Config given = load_given(options);
  if (has_everything(given)) {
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

bool is_of_run(const mp::TaskOptions& options) { return has_everything(load_given(options)); }

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
  mp::read_hosts(config, options.hosts);  // the code that starts the processes reads them again
  link::read_loss(config);
  link::read_log_limit(config);
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
  take_calibrated(c);
  c.check_all_used();
}

}  // namespace mrroc::launch
