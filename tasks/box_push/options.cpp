#include "tasks/box_push/options.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "base/command_line.hpp"
#include "base/fault.hpp"

namespace mrroc::box_push {
namespace {

constexpr const char* kToKey = "task.to";
constexpr const char* kBoxKey = "sim.boxes.box.start";

/// @throws FaultError bad_usage
std::array<double, 3> pose_of(const char* option, const std::vector<std::string>& words) {
  const auto refuse = [&] {
    throw FaultError(
        FaultCode::bad_usage, fmt::format("{} {}: not three numbers", option, fmt::join(words, " ")),
        fmt::format("give x and y in metres and an angle in degrees, such as {} 1.5 0.5 30", option));
  };
  if (words.size() != 3) refuse();
  std::array<double, 3> numbers{};
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    char* end = nullptr;
    numbers[k] = std::strtod(words[k].c_str(), &end);
    if (words[k].empty() || *end != '\0' || !std::isfinite(numbers[k])) refuse();
  }
  return numbers;
}

}  // namespace

void add_push_options(CommandLine& line, PushOptions& o) {
  line.option("--to", o.to, "Goal of the box: x, y in m, angle in degrees (default: 1.9 0.8 25)")
      .type_name("X Y DEG");
  line.option("--box", o.box, "Where the box stands at the beginning, in the same form (default: 0 0 0)")
      .type_name("X Y DEG");
}

std::vector<std::string> settings_of(const PushOptions& o) {
  std::vector<std::string> settings;
  if (!o.to.empty()) {
    const auto to = pose_of("--to", o.to);
    settings.push_back(fmt::format("{}=[{}, {}, {}]", kToKey, to[0], to[1], to[2]));
  }
  if (!o.box.empty()) {
    const auto box = pose_of("--box", o.box);
    settings.push_back(
        fmt::format("{}=[{}, {}, {}]", kBoxKey, box[0], box[1], box[2] * std::numbers::pi / 180));
  }
  return settings;
}

std::map<std::string, std::string> options_of_keys() { return {{kToKey, "--to"}, {kBoxKey, "--box"}}; }

}  // namespace mrroc::box_push
