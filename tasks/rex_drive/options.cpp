#include "tasks/rex_drive/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/closest_match.hpp"
#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

namespace mrroc::rex_drive {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPlanKey = "task.plan";
constexpr const char* kSpeedKey = "task.speed";
constexpr const char* kTrackerKey = "platforms.rex.tracker";
constexpr const char* kEyesKey = "task.eyes";
constexpr const char* kEstimatorKey = "platforms.rex.estimator";

/// A kind of ground, with what it sets.
struct Ground {
  std::string_view name;
  std::vector<std::string> settings{};
};
const std::array<Ground, 4>& grounds() {
  static const std::array<Ground, 4> list{{
      {"nominal"},
      {"slippery", {"sim.ground.friction=[0.35, 0.3]"}},
      {"ice_right", {"sim.ground.patches.ice.area=[-3, -2, 3, 0]", "sim.ground.patches.ice.scale=0.5"}},
      {"smooth", {"sim.ground.model=\"smooth\""}},
  }};
  return list;
}

bool is_ground(std::string_view name) {
  return std::ranges::find(grounds(), name, &Ground::name) != grounds().end();
}

std::string in_quotes(std::string_view text) {
  std::string escaped;
  for (const char c : text) {
    if (c == '"' || c == '\\') escaped += '\\';
    escaped += c;
  }
  return '"' + escaped + '"';
}

/// A shell makes an empty word of a variable that is not set. @throws FaultError bad_usage
void refuse_empty(const char* option, const std::optional<std::string>& word) {
  if (word && word->empty())
    throw FaultError(FaultCode::bad_usage, fmt::format("{}: the word behind it is empty", option),
                     "give one, or leave the option out");
}

std::vector<std::string> settings_of_ground(const std::string& name) {
  const auto found = std::ranges::find(grounds(), name, &Ground::name);
  if (found != grounds().end()) return found->settings;
  if (fs::is_regular_file(name)) return {};
  WordSet names;
  for (const Ground& ground : grounds()) names.emplace(ground.name);
  throw FaultError(
      FaultCode::bad_usage,
      fmt::format("--ground: there is no file and no ground '{}'{}", name, did_you_mean(name, names)),
      fmt::format("give one of {}, or a TOML file with [sim.ground]", fmt::join(names, ", ")));
}

/// A file that set something else, too, would change what its user does not think of. @throws ConfigError; FaultError bad_configuration
Config load_ground(const std::string& file) {
  using Tables = std::vector<std::string>;
  Config ground = Config::load(file);
  const Tables tables = ground.tables(""), of_sim = ground.tables("sim");
  if (tables == Tables{"sim"} && of_sim == Tables{"ground"}) return ground;
  throw FaultError(FaultCode::bad_configuration,
                   tables.empty() ? fmt::format("--ground: {} has no table", file)
                                  : fmt::format("--ground: {} has other tables than [sim.ground]", file),
                   "a ground is a table [sim.ground] with friction = [along, across], model, or "
                   "[sim.ground.patches.NAME]; other tables belong to --config");
}

/// Settings of cameras that the platform does not have would do nothing. @throws FaultError bad_configuration
void refuse_settings_of_no_eyes(const Config& config) {
  if (config.has("cameras.order")) return;  // a cell of the user's own, or of an earlier run
  std::string set;
  for (const char* const table : {"cameras", "odometry"})
    for (const std::string& name : config.tables(table)) set = fmt::format("{}.{}", table, name);
  if (config.has("cameras.profile")) set = "cameras.profile";
  if (set.empty()) return;
  throw FaultError(FaultCode::bad_configuration,
                   set + ": the platform has no cameras, since its eyes are off",
                   "--eyes on, or leave the setting out");
}

}  // namespace

void add_drive_options(CommandLine& line, DriveOptions& o) {
  line.option(
          "--eyes", o.eyes,
          "on: a pair of cameras sees the room, and visual odometry helps the estimator; off: several times "
          "as fast (default: on)")
      .one_of({"on", "off"});
  line.option(
          "--plan", o.plan,
          fmt::format("Points to drive through, a file of lines 'x y', or one of {} (default: figure_eight)",
                      fmt::join(built_in_plan_names(), ", ")))
      .type_name("FILE|NAME");
  line.option("--speed-mps", o.speed, "Speed wanted between the points, in m/s (default: 0.6)")
      .type_name("V");
  line.option("--tracker", o.tracker,
              "Trajectory tracker of the virtual effector: nmpc, kinematic, or another of the platform's "
              "(default: nmpc)")
      .type_name("NAME");
  line.option(
          "--estimator", o.estimator,
          "State estimator of the virtual effector: mhe, ekf, or another of the platform's (default: mhe)")
      .type_name("NAME");
  line.option(
          "--ground", o.ground,
          "nominal, slippery (half the friction), ice_right (half of it where y < 0), smooth (as the kernels "
          "believe it to be), or a TOML file with [sim.ground]")
      .type_name("NAME|FILE");
}

std::vector<std::string> settings_of(const DriveOptions& o) {
  refuse_empty("--plan", o.plan);
  refuse_empty("--tracker", o.tracker);
  refuse_empty("--estimator", o.estimator);
  refuse_empty("--ground", o.ground);
  std::vector<std::string> settings;
  const auto set = [&settings](const char* key, const std::string& value) {
    settings.push_back(fmt::format("{}={}", key, value));
  };
  if (o.plan) set(kPlanKey, in_quotes(is_built_in(*o.plan) ? *o.plan : fs::absolute(*o.plan).string()));
  if (o.speed) set(kSpeedKey, fmt::format("{}", *o.speed));
  if (o.tracker) set(kTrackerKey, in_quotes(*o.tracker));
  if (o.estimator) set(kEstimatorKey, in_quotes(*o.estimator));
  if (o.eyes) set(kEyesKey, *o.eyes == "on" ? "true" : "false");
  if (o.ground) std::ranges::move(settings_of_ground(*o.ground), std::back_inserter(settings));
  return settings;
}

std::map<std::string, std::string> options_of_keys() {
  return {{kPlanKey, "--plan"},
          {kSpeedKey, "--speed-mps"},
          {kTrackerKey, "--tracker"},
          {kEstimatorKey, "--estimator"},
          {kEyesKey, "--eyes"}};
}

void complete_drive(Config& config, const DriveOptions& o, PlanList& plans) {
  if (config.flag(kEyesKey, true))
    config.underlay(Config::parse(eyes(), "eyes.toml (built in)"));
  else
    refuse_settings_of_no_eyes(config);
  if (o.ground && !is_ground(*o.ground)) config.overlay(load_ground(*o.ground));
  const std::string key = "sim.platforms.rex.start";
  if (config.has(key)) {
    const auto [x, y, phi] = config.numbers<3>(key, std::nullopt, {-100, 100}, "m, rad: x, y, phi of B");
    plans.start = {x, y, wrap_angle(phi)};
    plans.start_line = 0;
  } else {
    examine_start(plans, config);  // the simulator would name the key, which nobody has written
    config.set(fmt::format("{}=[{}, {}, {}]", key, plans.start.x, plans.start.y, plans.start.phi));
  }
}

}  // namespace mrroc::rex_drive
