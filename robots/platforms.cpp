#include "robots/platforms.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "base/key_word.hpp"
#include "base/step_interval.hpp"
#include "edp/platform/driver.hpp"
#include "edp/platform/shell.hpp"
#include "edp/simulated_hardware.hpp"
#include "robots/driver_config.hpp"

namespace mrroc::robots {
namespace {

/// @param names  of algorithms, the first of which is the default
std::string read_algorithm(const Config& table, const char* key, std::span<const std::string_view> names) {
  std::vector<std::pair<std::string_view, std::string_view>> choices;
  for (const std::string_view name : names) choices.emplace_back(name, name);
  if (names.empty()) return {};
  return std::string(table.choice(key, names.front(), std::span(std::as_const(choices))));
}

}  // namespace

std::string driver_program(const PlatformType& type) {
  return type.program.empty() ? "edp_" + std::string(type.name) : std::string(type.program);
}

std::vector<std::string> read_platform_order(const Config& config) {
  auto keys = config.texts("platforms.order", std::vector<std::string>{});
  const auto arms = config.texts("robots.order", std::vector<std::string>{});
  const auto refuse = [](const std::string& text) {
    throw FaultError(FaultCode::bad_configuration, "platforms.order: " + text);
  };
  for (const std::string& key : keys) {
    if (!is_key_word(key))
      refuse(fmt::format("'{}' is no name of a platform: letters, digits, - and _, at most {}", key,
                         kLongestKey));
    if (std::ranges::count(keys, key) > 1) refuse(fmt::format("the platform '{}' is named twice", key));
    if (std::ranges::find(arms, key) != arms.end())
      refuse(fmt::format("'{}' is the name of an arm, too (robots.order); give one of them another", key));
  }
  return keys;
}

const PlatformType& read_platform_type(const Config& config, const std::string& key,
                                       std::span<const PlatformType* const> types) {
  if (types.empty())
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("platforms.{}: these programs have been built without any platform", key),
                     "build them with -DMRROC_REX=ON");
  std::vector<std::pair<std::string_view, const PlatformType*>> choices;
  const PlatformType* usual = types.front();
  for (const PlatformType* type : types) {
    choices.emplace_back(type->name, type);
    if (type->name == key) usual = type;
  }
  return *config.section("platforms." + key).choice("model", usual, std::span(std::as_const(choices)));
}

edp::PlatformDriverParameters read_platform_driver(const Config& config, const std::string& key,
                                                   const PlatformType& type) {
  // The grid of trackers and estimators is one of these steps.
  std::ignore = config.number("time.dt", edp::PlatformDriver::kStep,
                              {edp::PlatformDriver::kStep, edp::PlatformDriver::kStep}, "s");
  std::ignore = config.integer("time.n_s", kPlatformSteps, {kPlatformSteps, kPlatformSteps}, "steps");
  const Config t = config.section("platforms." + key);
  const edp::Platform& platform = type.platform();
  edp::PlatformDriverParameters d;
  d.estimator = read_algorithm(t, "estimator", platform.estimators());
  d.tracker = read_algorithm(t, "tracker", platform.trackers());
  d.adapt = t.flag("adapt", d.adapt);
  const auto nominal = t.numbers<2>("friction", {{d.nominal.mu_x, d.nominal.mu_y}}, {0.05, 1.5},
                                    "believed before it is estimated");
  d.nominal.mu_x = nominal[0];
  d.nominal.mu_y = nominal[1];
  d.synchro_rest = t.number("synchro_rest", d.synchro_rest, {0.1, 60}, "s");
  d.synchro_timeout = t.number("synchro_timeout", d.synchro_timeout, {1, 600}, "s");
  if (d.synchro_timeout <= d.synchro_rest)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format(
            "platforms.{0}.synchro_timeout: it must be longer than platforms.{0}.synchro_rest, {1:g} s", key,
            d.synchro_rest));
  d.silence = t.integer("silence", d.silence, {1, 1000}, "macrosteps");
  d.brake_after = t.integer("brake_after", d.brake_after, {1, 1000}, "macrosteps at rest");
  d.solver_fails = read_step_interval(config, "platforms." + key + ".solver_fails");
  return d;
}

link::NodeMain platform_driver_of(std::vector<const PlatformType*> types) {
  return [types = std::move(types)](link::Process& process, const Config& config,
                                    const link::NodeArguments& arguments) {
    process.needs_unlogged("the servo links");
    const std::string& key = arguments.arm;
    const auto keys = read_platform_order(config);
    if (std::ranges::find(keys, key) == keys.end())
      throw FaultError(FaultCode::bad_configuration, "platforms.order: '" + key + "' is not there");
    const PlatformType& type = read_platform_type(config, key, types);
    const edp::PlatformDriverParameters parameters = read_platform_driver(config, key, type);
    edp::ShellParameters shell;
    shell.robot = key;
    shell.ecp = "ecp-" + key;
    shell.dt = edp::PlatformDriver::kStep;
    shell.recording = read_recording(config, "platforms." + key);
    shell.folder = config.text("run.folder", std::nullopt);
    shell.injection = read_command_link(config, "platforms." + key);
    edp::PlatformDriver driver(type.platform(), parameters);
    edp::run_edp(process, driver, edp::SimulatedPlatform(process, key, "simulator", shell.dt), shell);
  };
}

}  // namespace mrroc::robots
