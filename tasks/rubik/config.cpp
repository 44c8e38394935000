#include "tasks/rubik/config.hpp"

#include "base/representation.hpp"

namespace mrroc::rubik {
namespace {

/// The cube's share in what hangs on the sensor of a hand that holds it.
Load with_cube(const Load& empty, double weight, const Vector3& place) {
  const double w = empty.weight + weight;
  return {w, (empty.weight * empty.mass_centre + weight * place) / w};
}

std::array<Load, 2> read_loads(const Config& config, Hand hand, double cube) {
  if (!config.has("robots." + kArmKeys[index(hand)] + ".tool.weight")) return {};
  const Config tool = config.section("robots." + kArmKeys[index(hand)] + ".tool");
  const auto r = tool.numbers<6>("pose", std::nullopt, {-10, 10}, "m, rad");
  const auto P = tool.numbers<3>("mass_centre", std::nullopt, {-1, 1}, "m");
  const Load empty{tool.number("weight", std::nullopt, {0, 50}, "N"), Vector3(P[0], P[1], P[2])};
  const Pose T_WE = pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(r.data()));
  return {empty, with_cube(empty, cube, T_WE * Vector3(0, 0, depth(hand)))};
}

}  // namespace

Parameters read_parameters(const Config& config) {
  std::ignore = config.number("time.dt", 0.002, {0.002, 0.002}, "s");
  std::ignore = config.integer("time.n_s", 10, {10, 10}, "steps");
  Parameters k;
  k.torque = config.number("task.torque", k.torque, {0.5, 10}, "N m about the face's axis");
  k.most_torque = config.number("task.most_torque", k.most_torque, {0.5, 10},
                                "N m to which it grows while a face stands");
  k.mobility = config.number("task.mobility", k.mobility, {0.001, 0.5}, "s/(kg m^2): B about it");
  k.attempts = config.integer("task.attempts", k.attempts, {1, 10}, "at a turn or a grip");
  k.timeout = config.integer("task.timeout", k.timeout, {50, 10'000}, "macrosteps of a behaviour");
  k.progress = config.number("task.progress", k.progress, {0.001, 1}, "rad of a turn");
  k.stall = config.integer("task.stall", k.stall, {25, 10'000}, "macrosteps without progress of a turn");
  k.held = config.number("task.held", k.held, {0.053, 0.09}, "m: jaws nearer than that hold nothing");
  k.slip = config.number("task.slip", k.slip, {0.001, 0.1}, "m that the cube may be off");
  k.open = config.number("task.open", k.open, {0.06, 0.08}, "m between the jaws of an empty hand");
  k.jaw_step =
      config.number("task.jaw_step", k.jaw_step, {0.0005, 0.01}, "m per macrostep; MG tab. 5: 0.001");
  k.grip_step =
      config.number("task.grip_step", k.grip_step, {0.0001, 0.01}, "m per macrostep; MG tab. 6: 0.001");
  k.opening_step =
      config.number("task.opening_step", k.opening_step, {0.0005, 0.02}, "m per macrostep; MG tab. 8: 0.001");
  const double cube = config.number("task.cube_weight", 0.981, {0, 10}, "N");
  for (const Hand hand : kHands) k.load[index(hand)] = read_loads(config, hand, cube);
  return k;
}

ecp::MotionLimits read_motion_limits(const Config& config, const std::string& arm, int axes) {
  const Config t = config.section("robots." + arm + ".motion");
  const auto n = static_cast<std::size_t>(axes);
  const auto v = t.list("velocity", Config::kRequired, {1, 250}, "rad/s", n);
  const auto a = t.list("acceleration", Config::kRequired, {1, 10'000}, "rad/s^2", n);
  return {Eigen::Map<const Eigen::VectorXd>(v.data(), axes),
          Eigen::Map<const Eigen::VectorXd>(a.data(), axes)};
}

}  // namespace mrroc::rubik
