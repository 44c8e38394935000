#include "sim/config.hpp"

#include <fmt/core.h>

#include <span>
#include <string>
#include <utility>

#include "sim/cube_config.hpp"
#include "sim/robot_description.hpp"
#include "sim/shell.hpp"
#include "sim/strokes_file.hpp"

namespace mrroc::sim {
namespace {

PaperParameters read_paper(const Config& t, PaperParameters p) {
  p.T_0P.p = Vector3(t.number("distance", p.T_0P.p.x(), {0.7, 1.1}, "m"), p.T_0P.p.y(),
                     t.number("height", p.T_0P.p.z(), {0.7, 1.2}, "m"));
  p.stiffness = t.number("stiffness", p.stiffness, {100, 1e6}, "N/m");
  p.damping_ratio = t.number("damping_ratio", p.damping_ratio, {0, 0.1}, "s");
  p.friction = t.number("friction", p.friction, {0, 2});
  return p;
}

HandParameters read_hand(const Config& t, HandParameters h) {
  h.stiffness = t.number("stiffness", h.stiffness, {50, 5000}, "N/m");
  h.damping = t.number("damping", h.damping, {0, 500}, "N s/m");
  h.speed = t.number("speed", h.speed, {0.001, 0.1}, "m/s");
  h.travel_speed = t.number("travel_speed", h.travel_speed, {0.001, 0.2}, "m/s");
  h.lowering_speed = t.number("lowering_speed", h.lowering_speed, {0.005, 0.05}, "m/s");
  h.lifting_speed = t.number("lifting_speed", h.lifting_speed, {0.005, 0.1}, "m/s");
  h.lift = t.number("lift", h.lift, {0.003, 0.03}, "m");
  h.uneven = t.number("uneven", h.uneven, {0, 0.01}, "m");
  h.dwell = t.number("dwell", h.dwell, {0, 5}, "s");
  h.press = t.number("press", h.press, {0.2, 10}, "N");
  h.press_wander = t.number("press_wander", h.press_wander, {0, 1});
  h.tremor = t.number("tremor", h.tremor, {0, 0.002}, "m");
  return h;
}

ForceSensorParameters read_sensor(const Config& t, ForceSensorParameters s) {
  s.force_noise = t.number("force_noise", s.force_noise, {0, 1}, "N");
  s.torque_noise = t.number("torque_noise", s.torque_noise, {0, 0.1}, "N m");
  s.force_bias = t.number("force_bias", s.force_bias, {0, 20}, "N");
  s.torque_bias = t.number("torque_bias", s.torque_bias, {0, 2}, "N m");
  return s;
}

void read_sensor_fault(const Config& robot, ForceSensorParameters& s) {
  s.fault = robot.choice("force_fault", s.fault,
                         {{"none", SensorFault::none},
                          {"stuck", SensorFault::stuck},
                          {"saturated", SensorFault::saturated},
                          {"silent", SensorFault::silent},
                          {"nan", SensorFault::nan}});
  s.fault_step = robot.integer("force_fault_step", s.fault_step, {0, 100'000'000}, "steps");
}

/// What is wrong with one switch, for tests of homing.
void read_switches(const Config& t, std::array<SwitchParameters, kMaxAxes>& switches) {
  const double place = t.number("place", switches[0].place, {-100, 100}, "rad of the motor");
  for (SwitchParameters& s : switches) s.place = place;
  const int axis = t.integer("faulty_axis", 0, {0, kMaxAxes - 1});
  switches[static_cast<std::size_t>(axis)].fault = t.choice("fault", SwitchFault::none,
                                                            {{"none", SwitchFault::none},
                                                             {"missing", SwitchFault::missing},
                                                             {"stuck", SwitchFault::stuck},
                                                             {"no_index", SwitchFault::no_index}});
}

PlateParameters read_plate(const Config& t, PlateParameters p) {
  p.shape = t.choice(
      "shape", p.shape,
      {{"none", PlateShape::none}, {"rectangle", PlateShape::rectangle}, {"ellipse", PlateShape::ellipse}});
  p.length = t.number("length", p.length, {0.01, 0.2}, "m");
  p.width = t.number("width", p.width, {0.01, 0.2}, "m");
  p.thickness = t.number("thickness", p.thickness, {0.002, 0.1}, "m");
  p.distance = t.number("distance", p.distance, {-0.2, 0.2}, "m");
  return p;
}

/// Where the base of an arm stands in the world. The default is not taken apart and put together again: its bits stay.
Pose read_place(const Config& robot, const Pose& fallback) {
  std::array<double, 6> usual{};
  Eigen::Map<AngleAxisPose>(usual.data()) = angle_axis_from_pose(fallback);
  const auto place = robot.numbers<6>("place", usual, {-10, 10}, "m, rad, of the base in the world");
  return place == usual ? fallback : pose_from_angle_axis(Eigen::Map<const AngleAxisPose>(place.data()));
}

/// The robot that a table names, with its usual parameters.
ArmParameters read_model(const Config& robot, ArmModel fallback) {
  std::vector<std::pair<std::string_view, int>> names{{robot_name(ArmModel::irb6_postument), 0},
                                                      {robot_name(ArmModel::irb6_track), 1}};
  const std::size_t added = names.size();
  for (const robots::Kind* kind : robots::catalogue())
    names.emplace_back(kind->name, static_cast<int>(names.size()));
  const auto chosen = static_cast<std::size_t>(
      robot.choice("model", fallback == ArmModel::irb6_postument ? 0 : 1, std::span(std::as_const(names))));
  if (chosen >= added) return arm_parameters(*robots::catalogue()[chosen - added]);
  return arm_parameters(chosen == 0 ? ArmModel::irb6_postument : ArmModel::irb6_track);
}

ArmParameters read_arm(const Config& config, const std::string& key, ArmModel fallback) {
  const Config robot = config.section("robots." + key);
  const Config sim = config.section("sim");
  ArmParameters arm = read_model(robot, fallback);
  arm.T_UB = read_place(robot, arm.T_UB);
  arm.kinematics = robot.choice(
      "true_kinematics", arm.kinematics,
      {{"nominal", irb6::ParameterSet::nominal}, {"calibrated", irb6::ParameterSet::calibrated}});
  arm.paper = read_paper(sim.section("paper"), arm.paper);
  arm.hand = read_hand(sim.section("hand"), arm.hand);
  arm.sensor = read_sensor(sim.section("sensor"), arm.sensor);
  read_sensor_fault(robot, arm.sensor);
  arm.plate = read_plate(robot.section("plate"), arm.plate);
  arm.pen_radius = sim.number("pen_radius", arm.pen_radius, {0.0005, 0.02}, "m");
  arm.start_height = sim.number("start_height", arm.start_height, {0.005, 0.1}, "m");
  read_switches(robot.section("switches"), arm.switches);
  if (robot.choice("gripper", false, {{"none", false}, {"two_jaw", true}})) arm.jaws = JawParameters{};
  read_fingers(robot, arm);
  arm.object = robot.number("object", 0, {0, 0.09}, "m between the jaws, 0: nothing");
  arm.lines.loop_back = robot.flag("lines.loop_back", arm.lines.loop_back);
  arm.lines.inputs = static_cast<std::uint16_t>(robot.integer("lines.inputs", 0, {0, 65535}, "bit mask"));
  arm.start = robot.list("start_joints", arm.start, {-10, 10}, "rad, m");
  const double scale = sim.number("motor_friction", 1, {0, 10}, "of the estimate");
  for (MotorParameters& m : arm.motors) m.friction *= scale;
  return arm;
}

}  // namespace

WorldParameters read_world(const Config& config) {
  WorldParameters w;
  w.substeps = config.integer("sim.substeps", w.substeps, {1, 16}, "per step");
  w.solver_iterations = config.integer("sim.solver_iterations", w.solver_iterations, {10, 1000});
  w.arms.clear();
  const auto keys = config.texts("robots.order", std::vector<std::string>{"arm1", "arm2"});
  for (const std::string& key : keys)
    w.arms.push_back(read_arm(config, key, w.arms.empty() ? ArmModel::irb6_postument : ArmModel::irb6_track));
  w.cube = read_cube(config, keys);
  return w;
}

void run_world_process(link::Process& process, const Config& config, const link::PartArguments&) {
  process.needs_unlogged("the servo links");
  ShellParameters shell;
  shell.robots = config.texts("robots.order", std::nullopt);
  for (const std::string& robot : shell.robots) shell.drivers.push_back("edp-" + robot);
  shell.n_s = config.integer("time.n_s", 10, {2, 32}, "steps");
  shell.speed = config.number("sim.speed", std::nullopt, {0, 1e4}, "of real time, 0: as fast as possible");
  shell.folder = config.text("run.folder", std::nullopt);
  if (const std::string strokes = config.text("run.strokes", std::nullopt); !strokes.empty())
    shell.strokes = read_strokes(strokes);
  const WorldParameters parameters = read_world(config);
  World world(parameters, static_cast<std::uint64_t>(config.integer<std::int64_t>("seed", 1)));
  const CameraWorld seen = read_camera_world(config, shell.robots);
  std::optional<CameraStation> cameras;
  if (!seen.cameras.empty()) cameras.emplace(process, seen, parameters, shell.robots);
  run_world(process, world, shell, cameras ? &*cameras : nullptr);
}

}  // namespace mrroc::sim
