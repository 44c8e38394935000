#include "tasks/rubik/cell/cell_settings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/representation.hpp"
#include "tasks/rubik/cell/cube_camera.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/reading/state_reading.hpp"

namespace mrroc::rubik {
namespace {

template <class Numbers>
std::string setting(const std::string& arm, const char* key, const Numbers& numbers) {
  return fmt::format("robots.{}.{}=[{:.6f}]", arm, key,
                     fmt::join(numbers.data(), numbers.data() + numbers.size(), ", "));
}

std::string pose_setting(const std::string& key, const Pose& T) {
  const AngleAxisPose r = angle_axis_from_pose(T);
  return fmt::format("{}=[{:.9f}]", key, fmt::join(r.data(), r.data() + r.size(), ", "));
}

/// The camera and the places where faces are shown to it.
std::vector<std::string> camera_settings() {
  const CameraSetup camera = cube_camera();
  const std::string prefix = fmt::format("cameras.{}.", camera.key);
  std::vector<std::string> settings{
      fmt::format("cameras.order=[\"{}\"]", camera.key), prefix + "mount=world",
      fmt::format("{}period={}", prefix, camera.period), fmt::format("{}fx={}", prefix, camera.model.fx),
      fmt::format("{}fy={}", prefix, camera.model.fy),   pose_setting(prefix + "pose", camera.place)};
  for (int reading = 0; reading < kReadings; ++reading)
    settings.push_back(pose_setting(fmt::format("cube_face.places.reading{}.pose", reading + 1),
                                    viewing_place(reading).T_UG));
  return settings;
}

}  // namespace

std::vector<std::string> cell_settings(bool sees) {
  std::vector<std::string> settings = sees ? camera_settings() : std::vector<std::string>{};
  const CellBelief cell = usual_cell();
  const auto start = joints_at_meeting(cell, kRetreatDistance);
  const CubePlanCell limits(cell);
  for (const Hand hand : kHands) {
    const std::string& arm = kArmKeys[index(hand)];
    settings.push_back(setting(arm, "start_joints", start[index(hand)]));
    settings.push_back(setting(arm, "motion.velocity", limits.limits(hand).motors.velocity));
    settings.push_back(setting(arm, "motion.acceleration", limits.limits(hand).motors.acceleration));
  }
  return settings;
}

void check_synchro(const Config& config) {
  for (const std::string& arm : kArmKeys)
    if (const std::string key = "robots." + arm + ".synchro"; config.text(key, "known_pose") == "homing")
      throw FaultError(
          FaultCode::bad_configuration,
          key +
              " is homing: on its way the hand would meet what stands around it; home the arms without "
              "the cube (./run manual), and begin with known_pose");
}

}  // namespace mrroc::rubik
