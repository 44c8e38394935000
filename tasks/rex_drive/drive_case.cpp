#include "tasks/rex_drive/drive_case.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include "tasks/rex_drive/config.hpp"
#include "tasks/rex_drive/options.hpp"
#include "tasks/rex_drive/plan/built_in_plans.hpp"

namespace mrroc::rex_drive {
namespace {

using Values = std::map<std::string, std::string>;

/// @param tables  beginnings of the keys
Values values_of(const Config& config, std::span<const std::string_view> tables) {
  Values values;
  for (const ConfigParameter& p : config.parameters())
    if (std::ranges::any_of(tables, [&p](std::string_view table) { return p.key.starts_with(table); }))
      values.emplace(p.key, p.value);
  return values;
}

/// What platform, ground, sensors and kernels are made of; not where the platform stands at the beginning.
Values plant_of(const Config& config) {
  constexpr std::array<std::string_view, 4> kPlant{"sim.ground.", "sim.platforms.", "motion_capture.",
                                                   "platforms.rex."};
  Values values = values_of(config, kPlant);
  std::erase_if(values, [](const auto& value) { return value.first.ends_with(".start"); });
  return values;
}

/// Whether a run may go faster than with the built-in configuration.
bool is_fast(const Config& run, const Config& usual) {
  const RouteLimits is = read_parameters(run).planner.route, was = read_parameters(usual).planner.route;
  return read_speed(run) > read_speed(usual) || is.lateral > was.lateral ||
         is.acceleration > was.acceleration || is.turn_rate > was.turn_rate;
}

}  // namespace

DriveCase drive_case(const Config& run, const std::function<void(const Config&)>& read) {
  constexpr std::array<std::pair<const char*, DriveCase>, 4> kGrounds{{{"nominal", DriveCase::usual},
                                                                       {"slippery", DriveCase::slippery},
                                                                       {"ice_right", DriveCase::ice_right},
                                                                       {"smooth", DriveCase::smooth}}};
  const Values plant = plant_of(run);
  for (const auto& [ground, drive] : kGrounds) {
    DriveOptions options;
    options.ground = ground;
    Config config = Config::parse(rex_drive::config(), "rex_drive.toml");
    for (const std::string& setting : settings_of(options)) config.set(setting);
    read(config);
    if (plant_of(config) != plant) continue;
    if (drive != DriveCase::usual) return drive;
    if (is_fast(run, config)) return DriveCase::fast;
    return is_built_in(run.text("task.plan", "figure_eight")) ? DriveCase::usual : DriveCase::own_plan;
  }
  return DriveCase::other;
}

std::vector<std::string> changed_eyes(const Config& run, const std::function<void(const Config&)>& read) {
  if (!read_eyes(run)) return {};
  constexpr std::array<std::string_view, 2> kEyes{"cameras.", "odometry."};
  Config usual = Config::parse(config(), "rex_drive.toml");
  usual.underlay(Config::parse(eyes(), "eyes.toml"));
  std::ignore = read_eyes(usual);  // as of the run above
  read(usual);
  const Values built_in = values_of(usual, kEyes);
  std::vector<std::string> changed;
  for (const auto& [key, value] : values_of(run, kEyes)) {
    const auto was = built_in.find(key);
    if (was == built_in.end() || was->second != value) changed.push_back(key);
  }
  return changed;
}

}  // namespace mrroc::rex_drive
