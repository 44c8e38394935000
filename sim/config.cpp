#include "sim/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "robots/catalogue.hpp"
#include "sim/artefact_config.hpp"
#include "sim/cube_config.hpp"
#include "sim/free_body_config.hpp"

namespace mrroc::sim {
namespace {

constexpr double kLeastHandMass = 0.2;  // [kg] that a grip moves without ringing from step to step

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
  h.tremor_frequency = t.number("tremor_frequency", h.tremor_frequency, {1, 20}, "Hz");
  h.drag = t.number("drag", h.drag, {0, 1000}, "N s/m");
  h.inertia = t.number("inertia", h.inertia, {0, 100}, "kg");
  h.mass = t.number("mass", h.mass, {0, 10}, "kg, 0: none");
  if (h.mass > 0 && h.mass < kLeastHandMass)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("sim.hand.mass: {:g} kg is too little to be simulated: 0 for a hand without "
                                 "a mass, or from {:g} on",
                                 h.mass, kLeastHandMass));
  h.grip_stiffness = t.number("grip_stiffness", h.grip_stiffness, {500, 20000}, "N/m");
  h.grip_damping = t.number("grip_damping", h.grip_damping, {0, 500}, "N s/m");
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

/// Defect of one switch, for tests of homing.
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

/// @return number of the kinematic model that the arm really has
int read_true_model(const Config& robot, const robots::RobotType& type) {
  if (type.parameter_sets.size() < 2) return 0;
  std::vector<std::pair<std::string_view, int>> names;
  for (const std::string_view name : type.parameter_sets)
    names.emplace_back(name, static_cast<int>(names.size()));
  return robot.choice("true_kinematics", 0, std::span(std::as_const(names)));
}

/// @param robot  its table
void read_start(const Config& robot, const std::string& key, ArmParameters& arm) {
  arm.start = robot.list("start_joints", arm.start, {-10, 10}, "rad, m");
  if (arm.start.empty() || arm.start.size() == arm.motors.size()) return;
  throw FaultError(FaultCode::bad_configuration,
                   fmt::format("robots.{}.start_joints: {} has {} axes, but {} joints are given", key,
                               arm.type->name, arm.motors.size(), arm.start.size()));
}

/// @param usual  name of the robot that it is unless the table says another
ArmParameters read_arm(const Config& config, const std::string& key, std::string_view usual) {
  const Config robot = config.section("robots." + key);
  const Config sim = config.section("sim");
  ArmParameters arm = arm_parameters(robots::read_type(config, key, robots::catalogue(), usual));
  arm.T_UB = robots::read_place(config, key, "sim", *arm.type);
  arm.model = read_true_model(robot, *arm.type);
  arm.paper = read_paper(sim.section("paper"), arm.paper);
  arm.hand = read_hand(sim.section("hand"), arm.hand);
  arm.sensor = read_sensor(sim.section("sensor"), arm.sensor);
  read_sensor_fault(robot, arm.sensor);
  arm.plate = read_plate(robot.section("plate"), arm.plate);
  arm.pen_radius = sim.number("pen_radius", arm.pen_radius, {0.0005, 0.02}, "m");
  arm.start_height = sim.number("start_height", arm.start_height, {0.005, 0.1}, "m");
  read_switches(robot.section("switches"), arm.switches);
  if (robot.choice("gripper", false, {{"none", false}, {"two_jaw", true}})) arm.jaws = JawParameters{};
  read_fingers(config, key, arm);
  read_palm(config, key, arm);
  arm.object = robot.number("object", 0, {0, 0.09}, "m between the jaws, 0: nothing");
  arm.lines.loop_back = robot.flag("lines.loop_back", arm.lines.loop_back);
  arm.lines.inputs = static_cast<std::uint16_t>(robot.integer("lines.inputs", 0, {0, 65535}, "bit mask"));
  read_start(robot, key, arm);
  const double scale = sim.number("motor_friction", 1, {0, 10}, "of the estimate");
  for (MotorParameters& m : arm.motors) m.friction *= scale;
  return arm;
}

/// The sheets of the arms lie on the belt of a conveyor, if there is one.
void check_belt(const WorldParameters& world) {
  constexpr double kGap = 1e-6;  // [m]
  for (const ArmParameters& conveyor : world.arms) {
    if (!conveyor.type->belt) continue;
    const double top = (conveyor.T_UB * conveyor.type->belt->middle).z();
    for (const ArmParameters& arm : world.arms)
      if (!arm.type->belt && std::abs((arm.T_UB * arm.paper.T_0P).p.z() - top) > kGap)
        throw FaultError(
            FaultCode::bad_configuration,
            fmt::format("sim.paper.height: the sheets lie on the conveyor, whose belt is {:g} m high", top));
  }
}

}  // namespace

WorldParameters read_world(const Config& config) {
  WorldParameters w;
  w.substeps = config.integer("sim.substeps", w.substeps, {1, 16}, "per step");
  w.solver_iterations = config.integer("sim.solver_iterations", w.solver_iterations, {10, 1000});
  std::vector<const robots::RobotType*> types;  // a conveyor is none unless the configuration says so
  std::ranges::copy_if(robots::catalogue(), std::back_inserter(types),
                       [](const robots::RobotType* type) { return !type->belt; });
  const auto keys = config.texts("robots.order", std::vector<std::string>{"arm1", "arm2"});
  for (const std::string& key : keys)
    w.arms.push_back(read_arm(config, key, types[std::min(w.arms.size(), types.size() - 1)]->name));
  check_belt(w);
  w.cube = read_cube(config, keys);
  w.free_body = read_true_body(config);
  w.artefact = read_true_artefact(config);
  return w;
}

}  // namespace mrroc::sim
