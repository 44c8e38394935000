#include "ui_cli/taught_points.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/config.hpp"
#include "base/fault.hpp"
#include "base/representation.hpp"
#include "base/text_file.hpp"

namespace mrroc::ui {
namespace {

constexpr std::string_view kHeading =
    "# Taught by hand with `ui_cli manual teach`; `./run move --file THIS_FILE` goes there.\n"
    "# tasks/move/README.md tells what else may stand here, such as another generator, times or "
    "velocities.\n\n";

struct SpaceWord {
  std::string_view word, key;  // of the operator, and in the file
  Representation space;
};
constexpr std::array kSpaces{SpaceWord{"motors", "motors", Representation::motors},
                             SpaceWord{"joints", "joints", Representation::joints},
                             SpaceWord{"frame", "frame", Representation::frame},
                             SpaceWord{"euler", "xyz_euler_zyz", Representation::xyz_euler_zyz},
                             SpaceWord{"angle-axis", "xyz_angle_axis", Representation::xyz_angle_axis}};

std::vector<double> numbers_of(const EffectorReply& r, Representation space, int axes) {
  if (space == Representation::motors) return {r.motors.begin(), r.motors.begin() + axes};
  if (space == Representation::joints) return {r.joints.begin(), r.joints.begin() + axes};
  PoseNumbers pose{};
  std::ranges::copy(r.T_0E, pose.begin());
  const auto T = pose_from_numbers(Representation::xyz_angle_axis, pose);
  if (!T) throw FaultError(FaultCode::not_finite, "the driver tells no pose of the arm");
  const PoseNumbers numbers = numbers_from_pose(space, *T);
  return {numbers.begin(), numbers.begin() + numbers_used(space, axes)};
}

}  // namespace

Representation space_of_word(std::string_view word) {
  const auto found = std::ranges::find(kSpaces, word, &SpaceWord::word);
  if (found == kSpaces.end())
    throw FaultError(
        FaultCode::bad_usage,
        fmt::format("'{:.40}' is no space; spaces are motors, joints, frame, euler and angle-axis", word));
  return found->space;
}

std::size_t teach_point(const std::filesystem::path& file, const std::string& arm, int axes,
                        Representation space, const EffectorReply& r) {
  Config taught = std::filesystem::exists(file) ? Config::load(file) : Config();
  const std::vector<double> numbers = numbers_of(r, space, axes);
  std::size_t points = 1;
  if (!taught.has(arm + ".start")) {
    taught.set(
        fmt::format("{}.start=[{}]", arm, fmt::join(numbers_of(r, Representation::joints, axes), ", ")));
  } else {
    const std::string_view key = std::ranges::find(kSpaces, space, &SpaceWord::space)->key;
    const std::string motion = arm + ".taught";
    const std::string there =
        taught.has(motion + ".space") ? taught.text(motion + ".space", Config::kRequired) : "";
    if (!there.empty() && there != key)
      throw FaultError(
          FaultCode::bad_usage,
          fmt::format("the positions of {} in {} are {}, and not {}", arm, file.string(), there, key),
          "name that space, or another file");
    std::vector<double> all;
    if (taught.has(motion + ".positions")) all = taught.list(motion + ".positions", Config::kRequired);
    all.insert(all.end(), numbers.begin(), numbers.end());
    points += all.size() / numbers.size();
    taught.set(fmt::format("{}.space=\"{}\"", motion, key));
    taught.set(fmt::format("{}.positions=[{}]", motion, fmt::join(all, ", ")));
    std::vector<std::string> order;
    if (taught.has(arm + ".order")) order = taught.texts(arm + ".order", Config::kRequired);
    if (std::ranges::find(order, "taught") == order.end()) {
      order.emplace_back("taught");
      taught.set(fmt::format("{}.order=[\"{}\"]", arm, fmt::join(order, "\", \"")));
    }
  }
  write_text_file(file, std::string(kHeading) + taught.dump());
  return points;
}

}  // namespace mrroc::ui
