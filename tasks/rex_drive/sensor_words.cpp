#include "tasks/rex_drive/sensor_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mrroc::rex_drive {
namespace {

std::string map_words(const SensorStatus& status) {
  constexpr double kLongest = 9999;  // [s]
  constexpr double kShort = 10;      // with a decimal
  const std::string state = status.map_seen ? "map" : "map lost";
  if (!status.map_age) return status.map_seen ? "map seen" : state;
  const double age = std::clamp(*status.map_age, 0.0, kLongest);
  return fmt::format("{} {:.{}f} s", state, age, age < kShort ? 1 : 0);
}

std::string odometry_words(const SensorStatus& status) {
  if (!status.odometry_seen) return "odometry none";
  if (!status.odometry_inliers) return "odometry seen";
  return fmt::format("odometry {}", std::clamp(*status.odometry_inliers, 0, 9999));
}

}  // namespace

std::string sensor_words(const SensorStatus& status) {
  return status.eyes ? odometry_words(status) + ", " + map_words(status) : map_words(status);
}

}  // namespace mrroc::rex_drive
