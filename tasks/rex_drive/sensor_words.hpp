// What the platform's sensors say, in words for terminals.
#pragma once
#include <optional>
#include <string>

namespace mrroc::rex_drive {

/// What is known of the map and of the odometry at a moment.
struct SensorStatus {
  bool map_seen{};  ///< the newest position on the map is valid
  std::optional<double>
      map_age;           ///< since the last one was measured [s]; nothing: there was none, or it is not known
  bool eyes{};           ///< the platform has cameras
  bool odometry_seen{};  ///< the newest reading of the odometry is valid
  std::optional<int> odometry_inliers;  ///< matches that it rests on; nothing: not known
};

/// @return e.g. "odometry 260, map 0.1 s", "map lost 12 s", "odometry none, map lost"; at most 31 characters
[[nodiscard]] std::string sensor_words(const SensorStatus& status);

}  // namespace mrroc::rex_drive
