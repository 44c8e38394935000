#include "sim/platform/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "sim/platform/platform_world.hpp"

namespace mrroc::sim {
namespace {

constexpr Bounds kPlace{-100, 100};  // [m]
constexpr Bounds kTime{0, 1e6};      // [s]
constexpr double kLastStep = 100'000'000;

[[noreturn]] void refuse(const std::string& key, const std::string& text) {
  throw FaultError(FaultCode::bad_configuration, key + ": " + text);
}

/// @param table  name of the one in which the key is
StepInterval read_interval(const Config& config, const std::string& table, const std::string& key) {
  const std::string name = table + "." + key;
  const auto steps = config.list(name, std::vector<double>{}, {0, kLastStep}, "steps from, to; empty: never");
  if (steps.empty()) return {};
  if (steps.size() != 2 || steps[0] != std::floor(steps[0]) || steps[1] != std::floor(steps[1]) ||
      steps[0] >= steps[1])
    refuse(name, "two whole numbers, the first step and a later one, with which it is over; or none");
  return {.from = static_cast<std::int64_t>(steps[0]), .to = static_cast<std::int64_t>(steps[1])};
}

PlatformFaults read_faults(const Config& config, const std::string& table) {
  PlatformFaults f;
  f.wheel = config.integer(table + ".wheel", f.wheel, {0, static_cast<int>(kWheels) - 1}, "FL, FR, RL, RR");
  f.wheel_blocked = read_interval(config, table, "wheel_blocked");
  f.encoder_stuck = read_interval(config, table, "encoder_stuck");
  f.imu_silent = read_interval(config, table, "imu_silent");
  f.imu_nan = read_interval(config, table, "imu_nan");
  f.load_stuck = read_interval(config, table, "load_stuck");
  f.load_wrong = read_interval(config, table, "load_wrong");
  f.load_silent = read_interval(config, table, "load_silent");
  return f;
}

void read_sensors(const Config& t, PlatformParameters& p) {
  p.imu.noise = t.number("imu.noise", p.imu.noise, {0, 1}, "rad/s");
  p.imu.bias = t.number("imu.bias", p.imu.bias, {0, 0.1}, "rad/s");
  p.imu.bias_walk = t.number("imu.bias_walk", p.imu.bias_walk, {0, 0.1}, "rad/s per root of a second");
  p.load_cells.noise = t.number("load_cells.noise", p.load_cells.noise, {0, 0.5}, "of the load");
  p.load_cells.bias = t.number("load_cells.bias", p.load_cells.bias, {0, 100}, "N");
}

/// @param key  of the platform
PlatformParameters read_platform(const Config& config, const std::string& key,
                                 const robots::PlatformType& type) {
  const std::string table = "sim.platforms." + key;
  const Config t = config.section(table);
  PlatformParameters p;
  p.body = type.plant;
  p.body.mass = t.number("mass", type.plant.mass, {type.plant.mass / 4, type.plant.mass * 4}, "kg");
  const double inertia = type.plant.inertia * p.body.mass / type.plant.mass;
  p.body.inertia = t.number("inertia", inertia, {type.plant.inertia / 10, type.plant.inertia * 10}, "kg m^2");
  p.body.bearing_friction = t.number("bearing_friction", p.body.bearing_friction, {0, 10}, "N m s/rad");
  p.body.brake = t.number("brake", p.body.brake, {0, 50}, "N m s/rad");
  p.centre = t.numbers<2>("centre", p.centre, {-10, 10}, "m, of mass, x and y in B");
  if (std::hypot(p.centre[0] / p.body.half_wheelbase, p.centre[1] / p.body.half_track) >= 1)
    refuse(table + ".centre",
           fmt::format("the centre of mass must be between the wheels, which stand at +-{:g} m, +-{:g} m",
                       p.body.half_wheelbase, p.body.half_track));
  p.height = t.number("height", p.height, {0, 2}, "m, of the centre of mass");
  p.load_time = t.number("load_time", p.load_time, {0, 1}, "s");
  p.motor_lag = t.number("motor_lag", p.motor_lag, {0, 0.1}, "s");
  p.ripple = t.number("ripple", p.ripple, {0, 0.5}, "of the torque");
  const auto start = t.numbers<3>("start", {{0, 0, 0}}, kPlace, "m, rad: x, y, phi of B");
  p.start = {.x = start[0], .y = start[1], .phi = start[2]};
  read_sensors(t, p);
  p.faults = read_faults(config, table + ".faults");
  return p;
}

GroundPatch read_patch(const Config& config, const std::string& table) {
  const Config t = config.section(table);
  const auto area =
      t.numbers<4>("area", std::nullopt, kPlace, "m: x y of the lower corner, of the upper one");
  if (area[0] >= area[2] || area[1] >= area[3])
    refuse(table + ".area",
           "the upper corner, its last two numbers, must be beyond the lower one in x and in y");
  return {.lower = {area[0], area[1]},
          .upper = {area[2], area[3]},
          .scale = t.number("scale", 0.5, {0.01, 10}, "of the friction"),
          .from = t.number("from", 0, kTime, "s")};
}

GroundParameters read_ground(const Config& config) {
  const Config t = config.section("sim.ground");
  GroundParameters g;
  g.model = t.choice("model", g.model, {{"sharp", GroundModel::sharp}, {"smooth", GroundModel::smooth}});
  g.slip_speed = t.number("slip_speed", g.slip_speed, {0.005, 0.2}, "m/s, of the model sharp");
  const auto friction = t.numbers<2>("friction", {{g.friction.mu_x, g.friction.mu_y}}, {0.02, 1.5},
                                     "along and across the wheels");
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
  w.micro_steps = config.integer("sim.micro_steps", w.micro_steps, {2, 100}, "per ms, of wheels");
  w.ground = read_ground(config);
  w.room = read_room(config);
  w.motion_capture = read_capture(config);
  for (const std::string& key : keys) {
    w.platforms.push_back(read_platform(config, key, robots::read_platform_type(config, key, types)));
    check_start(w, w.platforms.size() - 1, key);
  }
  return w;
}

}  // namespace mrroc::sim
