#include "tasks/visual_servo/config.hpp"

#include <algorithm>
#include <cmath>

#include "base/camera_config.hpp"
#include "tasks/visual_servo/servo.hpp"

namespace mrroc::visual_servo {
namespace {

constexpr int kMostFrames = 100;  // that task.max_age can be

Pose read_pose(const Config& table, std::string_view key) {
  const auto r = table.numbers<6>(key, std::nullopt, {-10, 10}, "m, rad");
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(r.data()));
}

RegulatorParameters read_regulator(const Config& t) {
  RegulatorParameters k;
  k.gain = t.number("gain", k.gain, {0.01, 1}, "of X Y Z per control step");
  k.angular_gain = t.number("angular_gain", k.angular_gain, {0.01, 1}, "of the angle per control step");
  k.quiet = t.number("quiet", k.quiet, {0.01, 1}, "of the gains");
  k.significance = t.number("significance", k.significance, {0, 20}, "standard deviations");
  k.speed = t.number("speed", k.speed, {0.001, 0.4}, "m/s");
  k.angular_speed = t.number("angular_speed", k.angular_speed, {0.01, 1.5}, "rad/s");
  k.top_speed = t.number("top_speed", k.top_speed, {0.001, 0.45}, "m/s");
  k.top_angular_speed = t.number("top_angular_speed", k.top_angular_speed, {0.01, 1.8}, "rad/s");
  k.acceleration = t.number("acceleration", k.acceleration, {0.1, 10}, "m/s^2");
  k.angular_acceleration = t.number("angular_acceleration", k.angular_acceleration, {0.1, 40}, "rad/s^2");
  return k;
}

TrackParameters read_track(const Config& t) {
  TrackParameters k;
  k.acceleration = t.number("acceleration", k.acceleration, {1e-3, 10}, "m/s^2");
  k.angular_acceleration = t.number("angular_acceleration", k.angular_acceleration, {1e-3, 30}, "rad/s^2");
  k.speed = t.number("speed", k.speed, {0, 2}, "m/s");
  k.angular_speed = t.number("angular_speed", k.angular_speed, {0, 5}, "rad/s");
  k.significance = t.number("significance", k.significance, {0, 20}, "standard deviations");
  k.jump = t.number("jump", k.jump, {1e-3, 1}, "m");
  k.angular_jump = t.number("angular_jump", k.angular_jump, {0.01, 3}, "rad");
  k.memory = t.integer("memory", k.memory, {1, 10'000}, "steps");
  return k;
}

/// @throws FaultError bad_configuration  the camera is mounted where c_1 cannot make use of it
CameraParameters camera_of(const CameraSetup& setup, Camera camera) {
  const CameraMount wanted = camera == Camera::sac ? CameraMount::base : CameraMount::robot;
  if (setup.mount != wanted || setup.robot != kArm)
    throw FaultError(FaultCode::bad_configuration, "cameras." + setup.key + ".mount: this task needs \"" +
                                                       std::string(kArm) +
                                                       (camera == Camera::sac ? ".base" : "") + "\"");
  CameraParameters k;
  k.place = setup.place;
  k.period = setup.period;
  k.latency = setup.latency;
  return k;
}

std::int64_t control_steps(double seconds, const ecp::Pacing& pacing) {
  return std::llround(seconds / pacing.macrostep_s());
}

}  // namespace

std::string_view channel_of(Object object) { return object == Object::chessboard ? "board" : "tag"; }

std::array<std::string, kCameras> reading_channels(Object object) {
  std::array<std::string, kCameras> channels;
  for (std::size_t n = 0; n < kCameras; ++n)
    channels[n] = std::string(kCameraNames[n]) + "." + std::string(channel_of(object));
  return channels;
}

Object read_object(const Config& config) {
  return config.choice("task.object", Object::chessboard,
                       {{"chessboard", Object::chessboard}, {"apriltag", Object::apriltag}});
}

void believe_late_pictures(Config& config) {
  if (config.has("task.max_age")) return;
  const int frames = longest_age(read_parameters(config.copy()));
  config.set("task.max_age=" + std::to_string(std::min(frames, kMostFrames)));
}

Parameters read_parameters(const Config& config) {
  Parameters k;
  const Config t = config.section("task");
  const std::vector<std::string> present = camera_keys(config);
  const auto refuse = [](const std::string& text) {
    throw ConfigError({"cameras", 0, 0}, "cameras.order", text);
  };
  if (present.empty()) refuse("the task needs a camera: sac, eih or both");
  for (const std::string& key : present)
    if (std::ranges::find(kCameraNames, key) == kCameraNames.end())
      refuse("this task has the cameras sac and eih, none called " + key);
  for (std::size_t n = 0; n < kCameras; ++n) {
    const std::string key(kCameraNames[n]);
    k.camera[n] = camera_of(read_camera(config, key), static_cast<Camera>(n));
    k.camera[n].used = std::ranges::find(present, key) != present.end();
  }
  k.T_EGd = read_pose(t, "desired");
  k.aggregation = t.choice("aggregation", k.aggregation,
                           {{"mean", Aggregation::mean},
                            {"switching", Aggregation::switching},
                            {"weights", Aggregation::weights}});
  k.regulator = read_regulator(t.section("regulator"));
  k.track = read_track(t.section("track"));
  k.feed_forward = t.flag("feed_forward", k.feed_forward);
  k.position_floor = t.number("position_floor", k.position_floor, {1e-6, 0.1}, "m");
  k.angle_floor = t.number("angle_floor", k.angle_floor, {1e-6, 0.1}, "rad");
  k.max_age = t.integer("max_age", k.max_age, {0, kMostFrames},
                        "frames; with --clock wall, unless it is given, as many as can be made use of");
  k.pacing.dt = config.number("time.dt", k.pacing.dt, {0.002, 0.002}, "s");
  const int n_s = config.integer("time.n_s", k.pacing.n_s, {2, 32}, "steps");
  k.pacing.n_s = static_cast<std::uint16_t>(n_s);
  k.pacing.n_Q = static_cast<std::uint16_t>(n_s - 1);
  for (const CameraParameters& camera : k.camera)
    if (camera.used && k.max_age * camera.period + camera.latency > kPosesKept - n_s)
      throw ConfigError(
          {"task", 0, 0}, "task.max_age",
          "where the arm was so long ago is not known any more: max_age * period + latency must be at most " +
              std::to_string(kPosesKept - n_s) + " steps");
  k.duration = control_steps(t.number("duration", 8, {0.1, 3600}, "s"), k.pacing);
  k.timeout = control_steps(t.number("timeout", 6, {0, 3600}, "s, 0: for ever"), k.pacing);
  return k;
}

}  // namespace mrroc::visual_servo
