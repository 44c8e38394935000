#include "base/camera_config.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/key_word.hpp"

namespace mrroc {
namespace {

// A picture's slot is needed until its reading is visible, and for some macrosteps more until it has been used.
constexpr std::int64_t kReadingKept = 60;  // [steps]
constexpr std::int64_t kPicturesKept = 8;  // slots of a frame store
constexpr std::string_view kBase = ".base";
constexpr Bounds kPoseBounds{-10, 10};  // [m], [rad]

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw ConfigError({"cameras", 0, 0}, key, text);
}

CameraModel read_model(const Config& t) {
  CameraModel m;
  m.width = t.integer("width", m.width, {16, 4096}, "pixels");
  m.height = t.integer("height", m.height, {16, 4096}, "pixels");
  m.fx = t.number("fx", m.fx, {10, 1e5}, "pixels");
  m.fy = t.number("fy", m.fx, {10, 1e5}, "pixels");
  m.cx = t.number("cx", (m.width - 1) / 2.0, {-1e4, 1e4}, "pixels");
  m.cy = t.number("cy", (m.height - 1) / 2.0, {-1e4, 1e4}, "pixels");
  m.distortion = t.numbers<5>("distortion", m.distortion, {-10, 10}, "k1, k2, p1, p2, k3");
  return m;
}

void read_mount(const Config& t, CameraSetup& camera) {
  const std::string mount = t.text("mount", "world");
  if (mount == "world") return;
  camera.mount = mount.ends_with(kBase) ? CameraMount::base : CameraMount::robot;
  camera.robot = camera.mount == CameraMount::base ? mount.substr(0, mount.size() - kBase.size()) : mount;
  if (!is_key_word(camera.robot))
    refuse("cameras." + camera.key + ".mount",
           "'" + mount + "' is not \"world\", an arm, an arm's .base, or a platform");
}

}  // namespace

CameraModel read_camera_model(const Config& config, const std::string& key) {
  return read_model(config.section("cameras." + key));
}

std::vector<std::string> camera_keys(const Config& config) {
  auto keys = config.texts("cameras.order", std::vector<std::string>{});
  for (const std::string& key : keys)
    if (!is_key_word(key))
      refuse("cameras.order", "'" + key + "' is no name of a camera: letters, digits, - and _, at most 16");
  for (const std::string& key : keys)
    if (std::ranges::count(keys, key) > 1) refuse("cameras.order", "the camera '" + key + "' is named twice");
  return keys;
}

Pose read_camera_place(const Config& config, const std::string& key) {
  const auto pose =
      config.numbers<6>("cameras." + key + ".pose", std::nullopt, kPoseBounds, "m, angle times axis in rad");
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(pose.data()));
}

CameraSetup read_camera(const Config& config, const std::string& key) {
  const Config t = config.section("cameras." + key);
  CameraSetup camera;
  camera.key = key;
  read_mount(t, camera);
  camera.place = read_camera_place(config, key);
  const std::string believed = "cell.cameras." + key + ".pose";
  const auto pose =
      config.list(believed, std::vector<double>{}, kPoseBounds, "m, rad; empty: as cameras." + key + ".pose");
  if (pose.size() == 6) camera.place = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(pose.data()));
  if (!pose.empty() && pose.size() != 6) refuse(believed, "x, y, z and angle times axis, or nothing");
  camera.model = read_model(t);
  camera.period = t.integer<std::int64_t>("period", camera.period, {1, 250}, "steps");
  camera.latency = t.integer<std::int64_t>("latency", camera.latency, {0, 200}, "steps");
  camera.on_demand = t.flag("on_demand", camera.on_demand);
  if (camera.latency + kReadingKept > kPicturesKept * camera.period)
    refuse("cameras." + key + ".period",
           "so many pictures would be under way that some are written over before they have been looked at: "
           "the period must "
           "be at least an eighth of the latency and 60 steps");
  return camera;
}

Pose looking_at(const Vector3& eye, const Vector3& target, const Vector3& up) {
  const Vector3 z = (target - eye).normalized();
  const Vector3 x = z.cross(up).normalized();
  Pose T;
  T.R << x, z.cross(x), z;
  T.p = eye;
  return T;
}

}  // namespace mrroc
