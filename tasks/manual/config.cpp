#include "tasks/manual/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "ecp/preparation.hpp"

namespace mrroc::manual {
namespace {

/// Names of positions, as the original had them.
constexpr std::array kPresets{"synchro", "front", "0", "1", "2"};

int axes_of(const Config& config, const std::string& arm) {
  return config.integer(fmt::format("robots.{}.axes", arm), 6, {1, kMaxAxes}, "");
}

/// @return the joints of a preset, which are as many as the arm has axes
PoseNumbers read_preset(const Config& config, const std::string& key, int axes) {
  PoseNumbers joints{};
  const auto read = [&]<std::size_t n>(std::integral_constant<std::size_t, n>) {
    std::ranges::copy(config.numbers<n>(key, std::nullopt, {-10, 10}, "rad, track m"), joints.begin());
  };
  if (axes == 7)
    read(std::integral_constant<std::size_t, 7>());
  else
    read(std::integral_constant<std::size_t, 6>());
  return joints;
}

}  // namespace

std::vector<ArmInfo> read_arms(const Config& config) {
  std::vector<ArmInfo> arms;
  for (const std::string& key : config.texts("robots.order", std::vector<std::string>{"arm1"})) {
    ArmInfo arm{.key = key, .axes = axes_of(config, key), .presets = {}};
    arm.jaws = config.choice("robots." + key + ".gripper", false, {{"none", false}, {"two_jaw", true}});
    for (const char* name : kPresets) {
      const std::string preset = fmt::format("robots.{}.presets.{}", key, name);
      if (config.has(preset)) arm.presets[name] = read_preset(config, preset, arm.axes);
    }
    arms.push_back(std::move(arm));
  }
  return arms;
}

Memory read_memory(const Config& config, const std::string& arm) {
  Memory c;
  c.axes = axes_of(config, arm);
  c.pacing.dt = config.number("time.dt", c.pacing.dt, {0.002, 0.002}, "s");
  c.pacing.n_s = static_cast<std::uint16_t>(config.integer("time.n_s", 10, {2, 32}, "steps"));
  c.pacing.n_Q = static_cast<std::uint16_t>(c.pacing.n_s - 1);
  c.model = ecp::read_tool_model(config, arm);
  return c;
}

}  // namespace mrroc::manual
