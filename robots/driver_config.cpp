#include "robots/driver_config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "base/link/real_time.hpp"
#include "edp/driver.hpp"
#include "edp/shell.hpp"
#include "robots/force_sensor_type.hpp"
#include "robots/gripper/jaws.hpp"

namespace mrroc::robots {
namespace {

/// Equal readings of one component that noise does not make: less than one in 1e20 for a sensor whose noise is
/// four of its increments.
constexpr int kStuckAfter = 25;

std::array<double, 6> numbers_of(const Pose& T) {
  const AngleAxisPose r = angle_axis_from_pose(T);
  std::array<double, 6> numbers;
  std::ranges::copy(r, numbers.begin());
  return numbers;
}

Pose read_pose(const Config& table, std::string_view key, const Pose& fallback) {
  const auto r = table.numbers<6>(key, numbers_of(fallback), {-10, 10}, "m, rad");
  return pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(r.data()));
}

void read_limits(const Config& table, const DriverDefaults& robot, edp::Limits& limits) {
  limits.linear_acceleration =
      table.number("limits.linear_acceleration", limits.linear_acceleration, {0.1, 1000}, "m/s^2");
  limits.angular_acceleration =
      table.number("limits.angular_acceleration", limits.angular_acceleration, {0.5, 5000}, "rad/s^2");
  limits.motor_acceleration =
      table.number("limits.motor_acceleration", limits.motor_acceleration, {100, 125'000}, "rad/s^2");
  const auto force = table.numbers<6>("limits.contact_force", robot.force_limit, {0, 1000}, "N, N m");
  std::ranges::copy(force, limits.contact_force.v.begin());
  // Lower and upper corner; empty: no workspace but the reach.
  const auto box = table.list("limits.workspace", std::vector<double>{}, {-10, 10}, "m");
  if (box.empty()) return;
  if (box.size() != 6 || box[0] >= box[3] || box[1] >= box[4] || box[2] >= box[5])
    throw FaultError(FaultCode::bad_configuration,
                     "limits.workspace: six numbers, the lower corner x y z and then the upper one [m]");
  limits.workspace = edp::Box{{box[0], box[1], box[2]}, {box[3], box[4], box[5]}};
}

}  // namespace

edp::DriverParameters read_driver(const Config& config, const std::string& key, const edp::Robot& robot,
                                  const DriverDefaults& defaults, const std::vector<double>& synchro_joints) {
  const Config table = config.section("robots." + key);
  edp::DriverParameters d;
  d.dt = config.number("time.dt", d.dt, {0.002, 0.002}, "s");
  d.n_s = config.integer("time.n_s", d.n_s, {2, 32}, "steps");
  d.stop_steps = table.integer("stop_steps", d.stop_steps, {1, 40}, "steps");
  const edp::ServoChoice standard = robot.axis(0).servo.standard;  // the same for all motors
  d.servo = {table.integer("servo.algorithm", standard.algorithm_no, {0, edp::kServoAlgorithms - 1}),
             table.integer("servo.parameter_set", standard.parameter_set_no, {0, edp::kServoSets - 1})};
  d.limits.linear_velocity =
      table.number("limits.linear_velocity", d.limits.linear_velocity, {0.001, 2}, "m/s");
  d.limits.angular_velocity =
      table.number("limits.angular_velocity", d.limits.angular_velocity, {0.001, 5}, "rad/s");
  read_limits(table, defaults, d.limits);
  d.force.T_WS = read_pose(table, "sensor_in_wrist", defaults.T_WS);
  d.force.range = read_force_sensor_type(config, key).range;
  for (const Axis a : {Axis::ax, Axis::ay, Axis::az}) d.limits.force[a] = d.force.range[a];
  d.force.average = table.integer("force_average", d.force.average, {1, 4}, "readings");
  d.force.low_pass = table.number("force_low_pass", d.force.low_pass, {0, 250}, "Hz, 0: none");
  d.oscillation.force = table.number("oscillation.force", d.oscillation.force, {0.1, 1e6}, "N");
  d.oscillation.torque = table.number("oscillation.torque", d.oscillation.torque, {0.01, 1e6}, "N m");
  d.oscillation.lowest = table.number("oscillation.lowest", d.oscillation.lowest, {0.5, 50}, "Hz");
  d.oscillation.softest = table.number("oscillation.softest", d.oscillation.softest, {0.001, 1},
                                       "share of its mobility that an axis keeps while its contact swings");
  d.oscillation.gears =
      table.number("elasticity", d.oscillation.gears, {0, 100}, "Hz of the gears, as believed, 0: rigid");
  d.force.stuck_after =
      table.integer("force_stuck_after", kStuckAfter, {0, 10'000}, "equal readings, 0: never");
  d.T_WE = read_pose(table, "tool.pose", defaults.T_WE);
  if (table.choice("gripper", false, {{"none", false}, {"two_jaw", true}})) d.gripper = gripper::two_jaw();
  if (d.gripper) d.jaws = table.number("jaws", d.jaws, {0.053, 0.09}, "m at SYNCHRO");
  if (d.gripper) d.jaws_known = table.flag("jaws_known", false);
  d.homing = defaults.homing;
  d.homing.returns = table.flag("homing_returns", true);
  using enum edp::Synchronisation;
  // Later readers of the table get the joints that the first reader knew.
  const bool known = !synchro_joints.empty() || table.has("synchro_joints");
  d.synchronisation =
      table.choice("synchro", known ? known_pose : homing, {{"homing", homing}, {"known_pose", known_pose}});
  if (d.synchronisation == homing) return d;
  const auto axes = static_cast<std::size_t>(robot.axes());
  const auto given =
      synchro_joints.empty() ? std::optional<std::vector<double>>{} : std::optional(synchro_joints);
  const auto joints = table.list("synchro_joints", given, {-10, 10}, "rad, m", axes);
  d.synchro_joints =
      Eigen::Map<const Eigen::VectorXd>(joints.data(), static_cast<Eigen::Index>(joints.size()));
  return d;
}

RobotModel read_tool(const Config& config, const std::string& key, const DriverDefaults& defaults) {
  const Config table = config.section("robots." + key);
  RobotModel m;
  m.set_tool = true;
  m.tool_representation = Representation::xyz_angle_axis;
  const auto tool = table.numbers<6>("tool.pose", numbers_of(defaults.T_WE), {-10, 10}, "m, rad");
  std::ranges::copy(tool, m.tool.begin());
  m.set_force_tool = true;
  m.weight = table.number("tool.weight", defaults.tool_weight, {0, 50}, "N");
  m.mass_centre = table.numbers<3>("tool.mass_centre", defaults.tool_mass_centre, {-1, 1}, "m");
  return m;
}

edp::Recording read_recording(const Config& config, const std::string& table) {
  using enum edp::Recording;
  return config.section(table).choice("record", on_fault,
                                      {{"never", never}, {"on_fault", on_fault}, {"always", always}});
}

link::Injection read_command_link(const Config& config, const std::string& table) {
  const Config t = config.section(table + ".command_link");
  link::Injection i;
  i.loss = t.number("loss", i.loss, {0, 1});
  i.duplication = t.number("duplication", i.duplication, {0, 1});
  i.delay = t.number("delay", i.delay, {0, 1});
  i.max_delay = t.integer("max_delay", i.max_delay, {1, link::Injection::kMaxDelay}, "macrosteps");
  i.seed = static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1));
  return i;
}

void run_driver(link::Process& process, const Config& config, const link::NodeArguments& arguments,
                const edp::Robot& robot, const edp::DriverParameters& parameters,
                std::span<const HardwareKind> own) {
  process.needs_unlogged("the servo links");
  const std::vector<std::string> arms = config.texts("robots.order", std::nullopt);
  if (std::ranges::find(arms, arguments.arm) == arms.end())
    throw FaultError(FaultCode::bad_configuration, "robots.order: '" + arguments.arm + "' is not there");
  edp::ShellParameters shell;
  shell.robot = arguments.arm;
  shell.dt = parameters.dt;
  shell.ecp = "ecp-" + arguments.arm;
  shell.axes = robot.axes();
  shell.recording = read_recording(config, "robots." + arguments.arm);
  shell.folder = config.text("run.folder", std::nullopt);
  shell.injection = read_command_link(config, "robots." + arguments.arm);
  HardwareChoice choice = read_hardware(config, arguments.arm);
  if (!arguments.hardware.empty()) choice.kind = arguments.hardware;
  if (!process.lock_step() && choice.core >= 0)
    process.log(fmt::format("{} core {}", link::pin_to_core(choice.core) ? "runs on" : "may not run on",
                            choice.core));
  edp::Driver driver(robot, parameters);
  edp::run_edp(process, driver,
               open_hardware(choice.kind, own, {process, config, arguments.arm, robot, parameters}), shell);
}

}  // namespace mrroc::robots
