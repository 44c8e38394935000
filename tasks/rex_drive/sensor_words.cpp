#include "tasks/rex_drive/sensor_words.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace mrroc::rex_drive {
namespace {

std::string map_words(const SensorNews& news) {
  constexpr double kLongest = 9999;  // [s]
  constexpr double kShort = 10;      // with a decimal
  const std::string state = news.map_seen ? "map" : "map lost";
  if (!news.map_age) return news.map_seen ? "map seen" : state;
  const double age = std::clamp(*news.map_age, 0.0, kLongest);
  return fmt::format("{} {:.{}f} s", state, age, age < kShort ? 1 : 0);
}

std::string odometry_words(const SensorNews& news) {
  if (!news.odometry_seen) return "odometry none";
  if (!news.odometry_inliers) return "odometry seen";
  return fmt::format("odometry {}", std::clamp(*news.odometry_inliers, 0, 9999));
}

}  // namespace

std::string sensor_words(const SensorNews& news) {
  return news.eyes ? odometry_words(news) + ", " + map_words(news) : map_words(news);
}

}  // namespace mrroc::rex_drive
