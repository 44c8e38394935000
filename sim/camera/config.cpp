#include "sim/camera/config.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "base/target/target_config.hpp"
#include "sim/errors.hpp"

namespace mrroc::sim {
namespace {

using camera::Colour;
using camera::RenderProfile;
using std::numbers::pi;

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw ConfigError({"cameras", 0, 0}, key, text);
}

void check_arm(const std::string& arm, const std::vector<std::string>& arms, const std::string& key) {
  if (std::ranges::find(arms, arm) == arms.end()) refuse(key, "there is no arm '" + arm + "'");
}

void check_mount(const CameraSetup& camera, const std::vector<std::string>& arms,
                 const std::vector<std::string>& platforms) {
  const std::string key = "cameras." + camera.key + ".mount";
  if (camera.mount == CameraMount::robot && std::ranges::find(platforms, camera.robot) != platforms.end())
    return;
  if (camera.mount != CameraMount::world) check_arm(camera.robot, arms, key);
}

RoomLook read_look(const Config& t, std::uint64_t seed) {
  RoomLook look;
  look.seed = t.integer("seed", static_cast<std::uint32_t>(seed % 1'000'000), {0U, 1'000'000U},
                        "usually that of the run");
  look.contrast = t.number("contrast", look.contrast, {0, 2}, "of what is on the floor");
  look.walls = t.number("walls", look.walls, {0, 1}, "contrast of the walls, as a share; 0: plain");
  look.height = t.number("height", look.height, {0.5, 5}, "m, of the walls");
  look.obstacles = t.number("obstacles", look.obstacles, {0.5, 5}, "m, of what stands in the room");
  return look;
}

CameraFaults read_camera_faults(const Config& config, const std::string& key) {
  const std::string table = "cameras." + key;
  CameraFaults faults{.silent = read_times(config, table + ".silent"),
                      .black = read_times(config, table + ".black"),
                      .frozen = read_times(config, table + ".frozen"),
                      .hangs = read_times(config, table + ".hangs"),
                      .shows = config.text(table + ".shows", key)};
  const std::vector<std::string> keys = camera_keys(config);
  if (std::ranges::find(keys, faults.shows) == keys.end())
    refuse(table + ".shows", "there is no camera '" + faults.shows + "'");
  return faults;
}

/// What nobody else knows of a camera: where it really stands, and its true lens.
void read_camera_errors(const Config& t, SimulatedCamera& c) {
  c.error = read_displacement(t.section("place_error"), "true place of the camera in the believed one",
                              "cameras.KEY.pose", {.shift = 0.5, .turn = 0.5});
  const double scale = t.number("focal_scale", 1, {0.5, 2},
                                {"", "true focal lengths over the believed ones", "cameras.KEY.fx, .fy"});
  const auto centre = [&](const char* axis) {
    return t.number(std::string("centre_error.") + axis, 0, {-200, 200},
                    {"pixels", "true middle of the lens less the believed one", "cameras.KEY.cx, .cy"});
  };
  CameraModel& lens = c.setup.model;
  constexpr std::array kNames{"k1", "k2", "p1", "p2", "k3"};
  for (std::size_t k = 0; k < kNames.size(); ++k)
    lens.distortion[k] = t.number(std::string("distortion.") + kNames[k], lens.distortion[k], {-10, 10},
                                  {"", "of the true lens", "cameras.KEY.distortion"});
  lens.fx *= scale;
  lens.fy *= scale;
  lens.cx += centre("x");
  lens.cy += centre("y");
}

SimulatedCamera read_simulated(const Config& config, const std::string& key, const RenderProfile& profile) {
  const Config t = config.section("cameras." + key);
  SimulatedCamera c;
  c.setup = read_camera(config, key);
  c.setup.place = read_camera_place(config, key);
  c.profile = profile;
  c.profile.channels = t.choice("picture", 3, {{"colour", 3}, {"grey", 1}});
  c.profile.noise = t.number("noise", c.profile.noise, {0, 50}, "grey values");
  c.profile.defocus = t.number("defocus", c.profile.defocus, {0, 10}, "pixels");
  c.exposure = t.integer<std::int64_t>("exposure", 0, {0, 1000}, "steps");
  c.instants = t.integer("instants", 1, {1, 64}, "of the exposure that are drawn");
  const std::int64_t after = c.exposure - c.exposure / 2;  // the picture's own step
  if (c.exposure >= c.setup.period || after > std::min(c.setup.latency, c.setup.period - 1))
    refuse("cameras." + key + ".exposure",
           "the exposure must be shorter than the period, and half of it not longer than the latency");
  read_camera_errors(config.section("sim.cameras." + key), c);
  c.faults = read_camera_faults(config, key);
  return c;
}

camera::Light read_light(const Config& t) {
  camera::Light light;
  const auto d = t.numbers<3>("direction", {{light.direction.x(), light.direction.y(), light.direction.z()}},
                              {-10, 10}, "towards the lamp, in the world");
  light.direction = Eigen::Map<const Vector3>(d.data());
  if (light.direction.norm() < 1e-3) refuse("cameras.light.direction", "it must not be zero");
  light.lamp = t.numbers<3>("lamp", light.lamp, {0, 5}, "red, green, blue");
  light.ambient = t.numbers<3>("ambient", light.ambient, {0, 5}, "red, green, blue");
  light.exposure = t.number("exposure", light.exposure, {0.01, 10});
  return light;
}

void read_motion(const Config& t, ObjectParameters& p) {
  p.motion = t.choice("motion", p.motion,
                      {{"rest", ObjectMotion::rest},
                       {"line", ObjectMotion::line},
                       {"circle", ObjectMotion::circle},
                       {"hand", ObjectMotion::hand}});
  p.start = t.number("start", p.start, {0, 1e4}, "s");
  p.heading = t.number("heading", p.heading, {-pi, pi}, "rad");
  p.speed = t.number("speed", p.speed, {0, 1}, "m/s");
  p.acceleration = t.number("acceleration", p.acceleration, {0.01, 100}, "m/s^2");
  p.length = t.number("length", p.length, {0, 2}, "m");
  p.radius = t.number("radius", p.radius, {0.005, 1}, "m");
  p.reach = t.number("reach", p.reach, {0, 0.5}, "m");
  p.turn = t.number("turn", p.turn, {0, 3}, "rad");
  p.pace = t.number("pace", p.pace, {0, 5}, "1/s");
  p.absent_until = t.number("absent_until", p.absent_until, {0, 1e4}, "s");
  p.hidden_from = t.number("hidden_from", p.hidden_from, {0, 1e4}, "s");
  p.hidden_for = t.number("hidden_for", p.hidden_for, {0, 1e4}, "s");
}

ObjectParameters read_object(const Config& config, const std::vector<std::string>& arms) {
  const Config t = config.section("object");
  ObjectParameters p;
  p.kind = t.choice("kind", p.kind,
                    {{"none", ObjectKind::none},
                     {"chessboard", ObjectKind::chessboard},
                     {"apriltag", ObjectKind::apriltag},
                     {"wrong_board", ObjectKind::wrong_board}});
  p.arm = t.text("arm", "arm1");
  const auto pose = t.numbers<6>("pose", {{0.9, 0, 0.93, 0, 0, 0}}, {-10, 10}, "m, angle times axis in rad");
  p.T_0G = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(pose.data()));
  p.in_hand = t.flag("in_hand", p.in_hand);
  if (p.in_hand)
    p.T_0G = displaced(p.T_0G, read_displacement(config.section("sim.object.place_error"),
                                                 "true place of the object in the hand, in the believed one",
                                                 "object.pose"));
  const Board board = read_board(config);
  p.board.columns = t.integer("columns", board.columns, {3, 20}, "inner corners");
  p.board.rows = t.integer("rows", board.rows, {3, 20}, "inner corners");
  p.board.square = t.number("square", board.square, {0.005, 0.1}, "m");
  const Tag tag = read_tag(config);
  p.tag = t.integer("tag", tag.id, {0, camera::kKnownTags - 1}, "tags that can be drawn");
  p.tag_edge = t.number("tag_edge", tag.edge, {0.01, 0.5}, "m");
  const Config truth = config.section("sim.object");
  p.board.square =
      truth.number("square", p.board.square, {0.005, 0.1}, {"m", "of the chessboard", "chessboard.square"});
  p.tag_edge =
      truth.number("tag_edge", p.tag_edge, {0.01, 0.5}, {"m", "of the tag's black border", "apriltag.edge"});
  read_motion(t, p);
  if (p.kind != ObjectKind::none) check_arm(p.arm, arms, "object.arm");
  if (p.in_hand && p.motion != ObjectMotion::rest)
    refuse("object.motion", "an object in the hand moves with the hand alone");
  return p;
}

}  // namespace

CameraWorld read_camera_world(const Config& config, const std::vector<std::string>& arms,
                              const std::vector<std::string>& platforms) {
  CameraWorld w;
  const std::vector<std::string> keys = camera_keys(config);
  if (keys.empty()) return w;
  const std::uint64_t seed = static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1));
  using Make = RenderProfile (*)();
  RenderProfile profile = config.choice<Make>("cameras.profile", &camera::exact_profile,
                                              {{"exact", &camera::exact_profile},
                                               {"fast", &camera::fast_profile},
                                               {"plain", &camera::plain_profile}})();
  for (const std::string& key : keys) {
    profile.seed = 64 * seed + w.cameras.size();
    w.cameras.push_back(read_simulated(config, key, profile));
    check_mount(w.cameras.back().setup, arms, platforms);
  }
  w.light = read_light(config.section("cameras.light"));
  if (!arms.empty()) w.object = read_object(config, arms);
  w.object.seed = seed;
  if (!platforms.empty()) w.look = read_look(config.section("room.look"), seed);
  return w;
}

}  // namespace mrroc::sim
