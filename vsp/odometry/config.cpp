#include "vsp/odometry/config.hpp"

#include <fmt/core.h>

#include <optional>

namespace mrroc::vsp {
namespace {

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw ConfigError({"odometry", 0, 0}, key, text);
}

void demand_equal(const StereoSetup& pair, const char* what, std::int64_t left, std::int64_t right) {
  if (left == right) return;
  refuse("odometry." + pair.key, fmt::format("the cameras of a pair have one {}: {} has {}, {} has {}", what,
                                             pair.left.key, left, pair.right.key, right));
}

void demand_mounted(const StereoSetup& pair, const CameraSetup& camera) {
  if (camera.mount != CameraMount::robot || camera.robot != pair.key)
    refuse("cameras." + camera.key + ".mount",
           fmt::format("the odometry of {} needs the camera on it: \"{}\"", pair.key, pair.key));
}

}  // namespace

StereoSetup read_stereo(const Config& config, const std::string& key) {
  const Config t = config.section("odometry." + key);
  StereoSetup pair;
  pair.key = key;
  const std::string left = t.text("left", std::nullopt);
  const std::string right = t.text("right", std::nullopt);
  if (left == right) refuse("odometry." + key + ".right", "one camera, '" + right + "', is no pair");
  StereoOdometryParameters& k = pair.parameters;
  k.inliers = t.integer("inliers", k.inliers, {6, 400});
  k.cells = t.integer("cells", k.cells, {1, 20});
  k.rms_px = t.number("rms", k.rms_px, {0.01, 10}, "pixels");
  k.way = t.number("way", k.way, {0.01, 1}, "m");
  k.change = t.number("change", k.change, {0.001, 2}, "m");
  pair.left = read_camera(config, left);
  pair.right = read_camera(config, right);
  demand_mounted(pair, pair.left);
  demand_mounted(pair, pair.right);
  demand_equal(pair, "width", pair.left.model.width, pair.right.model.width);
  demand_equal(pair, "height", pair.left.model.height, pair.right.model.height);
  demand_equal(pair, "period", pair.left.period, pair.right.period);
  demand_equal(pair, "latency", pair.left.latency, pair.right.latency);
  return pair;
}

}  // namespace mrroc::vsp
