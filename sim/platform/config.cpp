#include "sim/platform/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "base/closest_match.hpp"
#include "base/step_interval.hpp"
#include "sim/platform/platform_world.hpp"

namespace mrroc::sim {
namespace {

constexpr Bounds kPlace{-100, 100};  // [m]
constexpr Bounds kTime{0, 1e6};      // [s]

// What is believed instead.
constexpr const char* kModel = "the model of the platform";
constexpr const char* kSensors = "the noise that its estimator expects";
constexpr const char* kGround = "platforms.KEY.friction";
constexpr const char* kBox = "what the task is told of it";

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw FaultError(FaultCode::bad_configuration, key + ": " + text);
}

PlatformFaults read_faults(const Config& config, const std::string& table) {
  PlatformFaults f;
  f.wheel = config.integer(table + ".wheel", f.wheel, {0, static_cast<int>(kWheels) - 1},
                           {"FL, FR, RL, RR", "which of the wheels the faults are of", "none"});
  f.wheel_blocked = read_step_interval(config, table + ".wheel_blocked");
  f.encoder_stuck = read_step_interval(config, table + ".encoder_stuck");
  f.imu_silent = read_step_interval(config, table + ".imu_silent");
  f.imu_nan = read_step_interval(config, table + ".imu_nan");
  f.load_stuck = read_step_interval(config, table + ".load_stuck");
  f.load_wrong = read_step_interval(config, table + ".load_wrong");
  f.load_silent = read_step_interval(config, table + ".load_silent");
  return f;
}

void read_sensors(const Config& t, PlatformParameters& p) {
  p.imu.noise = t.number("imu.noise", p.imu.noise, {0, 1}, {"rad/s", "of the IMU's yaw rate", kSensors});
  p.imu.bias = t.number("imu.bias", p.imu.bias, {0, 0.1}, {"rad/s", "of the IMU's yaw rate", kSensors});
  p.imu.bias_walk = t.number("imu.bias_walk", p.imu.bias_walk, {0, 0.1},
                             {"rad/s per root of a second", "of the IMU's yaw rate", kSensors});
  p.load_cells.noise = t.number("load_cells.noise", p.load_cells.noise, {0, 0.5},
                                {"of the load", "of the load cells", kSensors});
  p.load_cells.bias =
      t.number("load_cells.bias", p.load_cells.bias, {0, 100}, {"N", "of the load cells", kSensors});
}

/// @param key  of the platform
PlatformParameters read_platform(const Config& config, const std::string& key,
                                 const robots::PlatformType& type) {
  const std::string table = "sim.platforms." + key;
  const Config t = config.section(table);
  PlatformParameters p;
  p.body = type.plant;
  p.body.mass = t.number("mass", type.plant.mass, {type.plant.mass / 4, type.plant.mass * 4},
                         {"kg", "of the platform", kModel});
  const double inertia = type.plant.inertia * p.body.mass / type.plant.mass;
  p.body.inertia = t.number("inertia", inertia, {type.plant.inertia / 10, type.plant.inertia * 10},
                            {"kg m^2", "of the platform about its vertical axis", kModel});
  p.body.bearing_friction =
      t.number("bearing_friction", p.body.bearing_friction, {0, 10}, {"N m s/rad", "of a wheel", kModel});
  p.body.brake =
      t.number("brake", p.body.brake, {0, 50}, {"N m s/rad", "of a short-circuited drive", kModel});
  p.body.quick_stop = t.number("quick_stop", p.body.quick_stop, {0, p.body.max_torque},
                               {"N m", "of the brakes without commands", kModel});
  p.centre =
      t.numbers<2>("centre", p.centre, {-10, 10}, {"m, of mass, x and y in B", "centre of mass", kModel});
  if (std::hypot(p.centre[0] / p.body.half_wheelbase, p.centre[1] / p.body.half_track) >= 1)
    refuse(table + ".centre",
           fmt::format("the centre of mass must be between the wheels, which stand at +-{:g} m, +-{:g} m",
                       p.body.half_wheelbase, p.body.half_track));
  p.height = t.number("height", p.height, {0, 2}, {"m", "of the centre of mass", kModel});
  p.load_time = t.number("load_time", p.load_time, {0, 1}, {"s", "in which loads shift", "none"});
  p.motor_lag = t.number("motor_lag", p.motor_lag, {0, 0.1}, {"s", "of the drives", "none"});
  p.ripple = t.number("ripple", p.ripple, {0, 0.5}, {"of the torque", "of the drives", "none"});
  const auto start = t.numbers<3>("start", {{0, 0, 0}}, kPlace,
                                  {"m, rad: x, y, phi of B", "place at the beginning", "motion capture"});
  p.start = {.x = start[0], .y = start[1], .phi = start[2]};
  read_sensors(t, p);
  p.faults = read_faults(config, table + ".faults");
  return p;
}

GroundPatch read_patch(const Config& config, const std::string& table) {
  const Config t = config.section(table);
  const auto area = t.numbers<4>(
      "area", std::nullopt, kPlace,
      {"m: x y of the lower corner, of the upper one", "rectangle with other friction", kGround});
  if (area[0] >= area[2] || area[1] >= area[3])
    refuse(table + ".area",
           "the upper corner, its last two numbers, must be beyond the lower one in x and in y");
  return {.lower = {area[0], area[1]},
          .upper = {area[2], area[3]},
          .scale = t.number("scale", 0.5, {0.01, 10}, {"of the friction", "in that rectangle", kGround}),
          .from = t.number("from", 0, kTime, {"s", "when the ground changes there", kGround})};
}

GroundParameters read_ground(const Config& config) {
  const Config t = config.section("sim.ground");
  GroundParameters g;
  g.model = t.choice("model", g.model, {{"sharp", GroundModel::sharp}, {"smooth", GroundModel::smooth}},
                     {"", "of friction over slip", kGround});
  g.slip_speed = t.number("slip_speed", g.slip_speed, {0.005, 0.2},
                          {"m/s", "slip at which the model sharp has 71 % of its friction", kGround});
  const auto friction = t.numbers<2>("friction", {{g.friction.mu_x, g.friction.mu_y}}, {0.02, 1.5},
                                     {"along and across the wheels", "coefficients of the ground", kGround});
  g.friction = {.mu_x = friction[0], .mu_y = friction[1]};
  for (const std::string& name : config.tables("sim.ground.patches"))
    g.patches.push_back(read_patch(config, "sim.ground.patches." + name));
  return g;
}

MotionCaptureParameters read_capture(const Config& config) {
  const Config t = config.section("motion_capture");
  MotionCaptureParameters m;
  m.setup = read_motion_capture(config);
  m.noise = t.numbers<2>("noise", m.noise, {0, 1}, "m of x and y, rad");
  m.outliers = t.number("outliers", m.outliers, {0, 1}, "of all readings");
  m.outlier = t.numbers<2>("outlier", m.outlier, {0, 10}, "m, rad");
  m.lost = read_times(config, "motion_capture.lost");
  const auto offset = t.numbers<3>("offset", {{0, 0, 0}}, {-10, 10}, "m, rad: x, y, phi");
  m.offset = {.x = offset[0], .y = offset[1], .phi = offset[2]};
  const auto displaced = read_times(config, "motion_capture.displaced");
  if (displaced.size() > 1) refuse("motion_capture.displaced", "one pair of times, or none");
  if (!displaced.empty()) m.displaced = displaced.front();
  return m;
}

/// @param name  of the box
BoxParameters read_box(const Config& config, const std::string& name) {
  const Config t = config.section("sim.boxes." + name);
  BoxParameters b;
  b.name = name;
  const auto size = t.numbers<2>("size", {{b.length, b.width}}, {0.05, 10},
                                 {"m, along x and y of the box", "of the box", kBox});
  b.length = size[0];
  b.width = size[1];
  b.mass = t.number("mass", b.mass, {0.1, 10'000}, {"kg", "of the box", kBox});
  b.friction = t.number("friction", b.friction, {0, 2}, {"", "of the box's base on the ground", kBox});
  b.grip =
      t.number("grip", b.grip, {0, 2}, {"", "friction of the box's sides against what touches them", kBox});
  const auto start =
      t.numbers<3>("start", std::nullopt, kPlace,
                   {"m, rad: x, y, phi of its middle", "where the box is at the beginning", kBox});
  b.start = {.x = start[0], .y = start[1], .phi = start[2]};
  return b;
}

/// Whether two rectangles overlap: there is no axis of one of them along which they are apart.
struct Outline {
  PlanarPose middle;
  double length{}, width{};
};
bool overlap(const Outline& one, const Outline& other) {
  const auto apart = [](const Outline& a, const Outline& b) {
    const double turned = b.middle.phi - a.middle.phi;
    const double c = std::abs(std::cos(turned)), s = std::abs(std::sin(turned));
    const double x = b.middle.x - a.middle.x, y = b.middle.y - a.middle.y;
    const double ca = std::cos(a.middle.phi), sa = std::sin(a.middle.phi);
    return std::abs(ca * x + sa * y) > (a.length + c * b.length + s * b.width) / 2 ||
           std::abs(ca * y - sa * x) > (a.width + s * b.length + c * b.width) / 2;
  };
  return !apart(one, other) && !apart(other, one);
}
Outline outline_of(const BoxParameters& b) { return {b.start, b.length, b.width}; }
Outline outline_of(const PlatformParameters& p) { return {p.start, p.body.length, p.body.width}; }

/// The outline of a box that begins there must be free, also of platforms and of other boxes.
void check_start(const PlatformWorldParameters& w, const BoxParameters& box,
                 const std::vector<std::string>& platforms) {
  const std::string where = "sim.boxes." + box.name + ".start";
  const RoomPoint there{box.start.x, box.start.y};
  const double reach = std::hypot(box.length, box.width) / 2;
  if (const std::string wrong = obstruction(w.room, there, there, reach); !wrong.empty())
    refuse(where, "it is " + wrong);
  for (std::size_t k = 0; k < w.platforms.size(); ++k)
    if (overlap(outline_of(box), outline_of(w.platforms[k])))
      refuse(where, "the platform '" + platforms[k] + "' begins there");
  for (const BoxParameters& other : w.boxes)
    if (overlap(outline_of(box), outline_of(other)))
      refuse(where, "the box '" + other.name + "' begins there" + did_you_mean(box.name, {other.name}));
}

void read_boxes(const Config& config, const std::vector<std::string>& platforms, PlatformWorldParameters& w) {
  const std::vector<std::string> names = config.tables("sim.boxes");
  if (names.size() > kMostBoxes)
    refuse("sim.boxes", fmt::format("{} boxes at most can be simulated, not {}", kMostBoxes, names.size()));
  for (const std::string& name : names) {
    if (std::ranges::find(platforms, name) != platforms.end())
      refuse("sim.boxes." + name, "a platform has this name");
    WordSet others(names.begin(), names.end());
    others.erase(name);
    if (!config.has("sim.boxes." + name + ".start"))
      refuse("sim.boxes." + name + ".start",
             "it is missing, and the box begins nowhere" + did_you_mean(name, others));
    const BoxParameters box = read_box(config, name);
    check_start(w, box, platforms);
    w.boxes.push_back(box);
  }
}

/// The outline of a platform that begins there must be free, also of another one.
void check_start(const PlatformWorldParameters& w, std::size_t k, const std::string& key) {
  const PlatformParameters& p = w.platforms[k];
  const double reach = std::hypot(p.body.length, p.body.width) / 2;
  const std::string where = "sim.platforms." + key + ".start";
  const RoomPoint there{p.start.x, p.start.y};
  if (const std::string wrong = obstruction(w.room, there, there, reach); !wrong.empty())
    refuse(where, "it is " + wrong);
  for (std::size_t other = 0; other < k; ++other) {
    const PlanarPose& q = w.platforms[other].start;
    if (std::hypot(q.x - p.start.x, q.y - p.start.y) < 2 * reach)
      refuse(where, fmt::format("another platform begins nearer than {:.2f} m to it", 2 * reach));
  }
}

}  // namespace

PlatformWorldParameters read_platform_world(const Config& config, const std::vector<std::string>& keys,
                                            std::span<const robots::PlatformType* const> types) {
  if (keys.empty() || keys.size() > kMostPlatforms)
    refuse("platforms.order",
           fmt::format("one or {} platforms can be simulated, not {}", kMostPlatforms, keys.size()));
  PlatformWorldParameters w;
  w.micro_steps =
      config.integer("sim.micro_steps", w.micro_steps, {2, 100}, {"per ms", "of the integration of wheels"});
  w.ground = read_ground(config);
  w.room = read_room(config);
  w.motion_capture = read_capture(config);
  for (const std::string& key : keys) {
    w.platforms.push_back(read_platform(config, key, robots::read_platform_type(config, key, types)));
    check_start(w, w.platforms.size() - 1, key);
  }
  read_boxes(config, keys, w);
  return w;
}

}  // namespace mrroc::sim
