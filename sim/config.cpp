#include "sim/config.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "base/table_config.hpp"
#include "robots/catalogue.hpp"
#include "robots/force_sensor_type.hpp"
#include "sim/artefact_config.hpp"
#include "sim/cube_config.hpp"
#include "sim/engine.hpp"
#include "sim/errors.hpp"
#include "sim/free_body_config.hpp"

namespace mrroc::sim {
namespace {

constexpr double kLeastElasticity = 5;  // [Hz]
constexpr double kLeastHandMass = 0.2;  // [kg] that a grip moves without ringing from step to step

Pose sheet_at(Pose T_0P, double distance, double height) {
  T_0P.p = Vector3(distance, T_0P.p.y(), height);
  return T_0P;
}

/// @param told  what is told of the table @param p  the rest
PaperParameters read_paper(const Config& t, const TableDescription& told, PaperParameters p) {
  using Of = TableBounds;
  p.T_0P = sheet_at(p.T_0P,
                    t.number("distance", told.distance, Of::kDistance,
                             {"m", "middle of the sheet from the arm's base", "table.distance"}),
                    t.number("height", told.height, Of::kHeight,
                             {"m", "of the sheet above the arm's base", "table.height"}));
  const Meaning tilt{"rad", "of table and sheet, about that axis of the sheet", "level"};
  const double x = t.number("tilt.x", 0, {-0.2, 0.2}, tilt);
  const double y = t.number("tilt.y", 0, {-0.2, 0.2}, tilt);
  p.T_0P = displaced(p.T_0P, {rotation_from_angle_axis({x, y, 0}), Vector3::Zero()});
  p.stiffness = t.number("stiffness", told.stiffness, Of::kStiffness,
                         {"N/m", "of paper and plates with the tool that touches them", "table.stiffness"});
  p.damping_ratio = t.number("damping_ratio", told.damping_ratio, Of::kDampingRatio,
                             {"s", "of the same, damping per stiffness", "table.damping_ratio"});
  p.friction = t.number("friction", told.friction, Of::kFriction,
                        {"", "of the tool on paper and plates", "table.friction"});
  return p;
}

constexpr const char* kOperator = "the operator knows his hand";

void read_grip(const Config& t, HandParameters& h) {
  h.mass = t.number("mass", h.mass, {0, 10}, {"kg, 0: none", "of hand and forearm", kOperator});
  if (h.mass > 0 && h.mass < kLeastHandMass)
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("sim.hand.mass: {:g} kg is too little to be simulated: 0 for a hand without "
                                 "a mass, or from {:g} on",
                                 h.mass, kLeastHandMass));
  h.grip_stiffness = t.number("grip_stiffness", h.grip_stiffness, {500, 20000},
                              {"N/m", "between a hand with a mass and the tool", kOperator});
  h.grip_damping = t.number("grip_damping", h.grip_damping, {0, 500},
                            {"N s/m", "between a hand with a mass and the tool", kOperator});
}

HandParameters read_hand(const Config& t, HandParameters h) {
  h.stiffness = t.number("stiffness", h.stiffness, {50, 5000},
                         {"N/m", "from where the hand wants to be to the tool", kOperator});
  h.damping = t.number("damping", h.damping, {0, 500}, {"N s/m", "of the same", kOperator});
  h.speed = t.number("speed", h.speed, {0.001, 0.1}, {"m/s", "largest along a stroke"});
  h.travel_speed = t.number("travel_speed", h.travel_speed, {0.001, 0.2}, {"m/s", "largest above the paper"});
  h.lowering_speed = t.number("lowering_speed", h.lowering_speed, {0.005, 0.05}, {"m/s", "down, in the air"});
  h.lifting_speed = t.number("lifting_speed", h.lifting_speed, {0.005, 0.1}, {"m/s", "up"});
  h.lift = t.number("lift", h.lift, {0.003, 0.03}, {"m", "of travel above the paper"});
  h.uneven = t.number("uneven", h.uneven, {0, 0.01}, {"m", "amplitude of the uneven height of travel"});
  h.dwell = t.number("dwell", h.dwell, {0, 5}, {"s", "of rest after touching the paper"});
  h.press = t.number("press", h.press, {0.2, 10}, {"N", "on the paper, as the operator wants it"});
  h.press_wander =
      t.number("press_wander", h.press_wander, {0, 1}, {"", "relative standard deviation of that force"});
  h.tremor = t.number("tremor", h.tremor, {0, 0.002}, {"m", "of the hand, per axis, rms", "none"});
  h.tremor_frequency =
      t.number("tremor_frequency", h.tremor_frequency, {1, 20}, {"Hz", "of the tremor", "none"});
  h.drag = t.number("drag", h.drag, {0, 1000},
                    {"N s/m", "that the operator expects of the arm he leads: 1/B", "the law of the task"});
  h.inertia = t.number("inertia", h.inertia, {0, 100},
                       {"kg", "that the operator expects of the arm he leads: I", "the law of the task"});
  read_grip(t, h);
  const double scale =
      t.number("scale", 1, {0.1, 10}, {"", "of stiffness and damping of hand and grip", kOperator});
  for (double* const each : {&h.stiffness, &h.damping, &h.grip_stiffness, &h.grip_damping}) *each *= scale;
  return h;
}

constexpr const char* kExactSensor = "exact, less its offset when it is biased";

ForceSensorParameters read_sensor(const Config& t, ForceSensorParameters s) {
  s.force_noise = t.number("force_noise", s.force_noise, {0, 1},
                           {"N", "standard deviation of a reading of a force sensor", kExactSensor});
  s.torque_noise = t.number("torque_noise", s.torque_noise, {0, 0.1},
                            {"N m", "standard deviation of a reading of a force sensor", kExactSensor});
  s.force_bias = t.number("force_bias", s.force_bias, {0, 20},
                          {"N", "largest constant offset, drawn once per seed", kExactSensor});
  s.torque_bias = t.number("torque_bias", s.torque_bias, {0, 2},
                           {"N m", "largest constant offset, drawn once per seed", kExactSensor});
  return s;
}

/// @param t  of one arm
ForceSensorParameters read_own_sensor(const Config& t, ForceSensorParameters s) {
  s.gain = t.number("gain", s.gain, {0.1, 10}, {"", "of the force sensor, reading over load", kExactSensor});
  s.turn = read_turn(t.section("turn"), "of the force sensor's axes", "robots.ARM.sensor_in_wrist");
  s.force_drift = t.number("force_drift", s.force_drift, {0, 1},
                           {"N/s", "largest drift of the force sensor, drawn once per seed", kExactSensor});
  s.torque_drift =
      t.number("torque_drift", s.torque_drift, {0, 0.1},
               {"N m/s", "largest drift of the force sensor, drawn once per seed", kExactSensor});
  s.delay =
      t.integer("delay", s.delay, {0, 50}, {"steps", "age of the force sensor's readings", kExactSensor});
  return s;
}

/// The transducer that everybody knows.
void take_type(const robots::ForceSensorType& type, ForceSensorParameters& s) {
  s.range_xy = type.range[Axis::x];
  s.range_z = type.range[Axis::z];
  s.range_torque = type.range[Axis::az];
  for (double* const each : {&s.force_noise, &s.torque_noise, &s.force_resolution, &s.torque_resolution})
    *each *= type.coarseness;
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

/// @param t  what is told of it
PlateParameters read_told_plate(const Config& t, PlateParameters p) {
  p.shape = t.choice(
      "shape", p.shape,
      {{"none", PlateShape::none}, {"rectangle", PlateShape::rectangle}, {"ellipse", PlateShape::ellipse}});
  p.length = t.number("length", p.length, {0.01, 0.2}, "m");
  p.width = t.number("width", p.width, {0.01, 0.2}, "m");
  p.thickness = t.number("thickness", p.thickness, {0.002, 0.1}, "m");
  p.distance = t.number("distance", p.distance, {-0.2, 0.2}, "m");
  return p;
}

/// @param told  what is told of it
PlateParameters read_true_plate(const Config& t, const PlateParameters& told) {
  PlateParameters p = told;
  p.length = t.number("length", told.length, {0.01, 0.2},
                      {"m", "of the plate along x of the sheet", "robots.ARM.plate.length"});
  p.width = t.number("width", told.width, {0.01, 0.2},
                     {"m", "of the plate along y of the sheet", "robots.ARM.plate.width"});
  p.thickness = t.number("thickness", told.thickness, {0.002, 0.1},
                         {"m", "of the plate", "robots.ARM.plate.thickness"});
  p.distance = t.number("distance", told.distance, {-0.2, 0.2},
                        {"m", "of the plate's middle from that of the sheet", "robots.ARM.plate.distance"});
  return p;
}

/// @return number of a model's set of lengths, with the first rule for the redundant axis
int set_of(const robots::RobotType& type, int model) {
  return type.parameter_sets.size() < 2 ? 0 : model % static_cast<int>(type.parameter_sets.size());
}

/// @return number of the set of lengths that the arm really has
int read_true_model(const Config& sim_arm, const robots::RobotType& type, int believed) {
  if (type.parameter_sets.size() < 2) return 0;
  std::vector<std::pair<std::string_view, int>> names{{"as_given", -1}};
  for (const std::string_view name : type.parameter_sets)
    names.emplace_back(name, static_cast<int>(names.size()) - 1);
  const int set =
      sim_arm.choice("kinematics", -1, std::span(std::as_const(names)),
                     {"", "set of lengths and zero positions of the arm", "robots.ARM.kinematics"});
  return set >= 0 ? set : believed;
}

/// @param all  [sim] @param own  of one arm
void read_motors(const Config& all, const Config& own, ArmParameters& arm) {
  constexpr Bounds kScale{0.1, 10};
  const char* const believed = "the regulators' coefficients";
  const double friction =
      all.number("motor_friction", 1, {0, 10},
                 {"", "of the motors of all arms and their jaws, over the estimate", believed}) *
      own.number("friction_scale", 1, {0, 10},
                 {"", "of the motors of that arm and its jaws, besides sim.motor_friction", believed});
  const double torque = own.number("torque_constant_scale", 1, kScale,
                                   {"", "of the motors, that of the jaws too, over the estimate", believed});
  const double resistance =
      own.number("resistance_scale", 1, kScale,
                 {"", "of the motors, that of the jaws too, over the estimate", believed});
  const double rotor = own.number("rotor_inertia_scale", 1, kScale,
                                  {"", "of the motors, that of the jaws too, over the estimate", believed});
  const auto scale = [&](MotorParameters& m) {
    m.friction *= friction;
    m.torque_constant *= torque;
    m.resistance *= resistance;
    m.rotor_inertia *= rotor;
  };
  std::ranges::for_each(arm.motors, scale);
  if (arm.jaws) scale(arm.jaws->motor);
}

/// Where the arm stands at the beginning, as those believe who put it there.
void read_start(const Config& config, const std::string& key, const TableDescription& table, int model,
                ArmParameters& arm) {
  arm.start = config.section("robots." + key).list("start_joints", arm.start, {-10, 10}, "rad, m");
  if (!arm.start.empty() && arm.start.size() != arm.motors.size())
    throw FaultError(FaultCode::bad_configuration,
                     fmt::format("robots.{}.start_joints: {} has {} axes, but {} joints are given", key,
                                 arm.type->name, arm.motors.size(), arm.start.size()));
  arm.start_height = config.number("sim.start_height", arm.start_height, {0.005, 0.1},
                                   {"m", "of the tool above the sheet at the beginning, as everybody knows"});
  arm.start_belief = {model, sheet_at(PaperParameters{}.T_0P, table.distance, table.height)};
}

void read_hand_parts(const Config& config, const std::string& key, ArmParameters& arm) {
  const Config robot = config.section("robots." + key);
  if (robot.choice("gripper", false, {{"none", false}, {"two_jaw", true}})) arm.jaws = JawParameters{};
  read_fingers(config, key, arm);
  read_palm(config, key, arm);
  arm.object = robot.number("object", 0, {0, 0.09}, "m between the jaws, 0: nothing");
}

/// @param truth  the arm's table of what is true
ElasticityParameters read_elasticity(const Config& truth, ElasticityParameters e) {
  e.frequency =
      truth.number("elasticity", e.frequency, {0, 40},
                   {"Hz", "of the first mode of the gears, from 5 on; 0: rigid", "robots.ARM.elasticity"});
  if (e.frequency > 0 && e.frequency < kLeastElasticity)
    throw FaultError(
        FaultCode::bad_configuration,
        fmt::format("sim.robots.ARM.elasticity: {:g} Hz is less than an arm has that bears its own "
                    "weight: 0 for rigid gears, or from {:g} on",
                    e.frequency, kLeastElasticity));
  e.damping = truth.number("elasticity_damping", e.damping, {0, 0.5}, {"", "ratio of that mode", "the same"});
  return e;
}

/// @param usual  name of the robot that it is unless the table says another
ArmParameters read_arm(const Config& config, const std::string& key, std::string_view usual) {
  const Config robot = config.section("robots." + key);
  const Config sim = config.section("sim");
  const Config own = sim.section("robots." + key);
  const TableDescription table = read_table(config);
  ArmParameters arm = arm_parameters(robots::read_type(config, key, robots::catalogue(), usual));
  const int believed = set_of(*arm.type, robots::read_robot(config, key, *arm.type)->model());
  arm.T_UB =
      displaced(robots::read_place(config, key, "sim", *arm.type),
                read_displacement(own.section("base_error"), "true base in the believed one",
                                  "robots.ARM.place, cell.robots.ARM.place", {.shift = 1, .turn = 3.2}));
  arm.model = read_true_model(own, *arm.type, believed);
  arm.elasticity = read_elasticity(own, arm.elasticity);
  arm.paper = read_paper(sim.section("paper"), table, arm.paper);
  arm.hand = read_hand(sim.section("hand"), arm.hand);
  arm.sensor = read_own_sensor(own.section("sensor"), read_sensor(sim.section("sensor"), arm.sensor));
  take_type(robots::read_force_sensor_type(config, key), arm.sensor);
  read_sensor_fault(robot, arm.sensor);
  arm.plate = read_true_plate(own.section("plate"), read_told_plate(robot.section("plate"), arm.plate));
  arm.pen_radius = sim.number("pen_radius", arm.pen_radius, {0.0005, 0.02},
                              {"m", "of the ball that touches the paper", "none"});
  read_switches(robot.section("switches"), arm.switches);
  read_hand_parts(config, key, arm);
  arm.links = read_link_errors(own, link_names(*arm.type));
  arm.lines.loop_back = robot.flag("lines.loop_back", arm.lines.loop_back);
  arm.lines.inputs = static_cast<std::uint16_t>(robot.integer("lines.inputs", 0, {0, 65535}, "bit mask"));
  read_start(config, key, table, believed, arm);
  read_motors(sim, own, arm);
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
    for (const ArmParameters& arm : world.arms)
      if (arm.paper.T_0P.R != PaperParameters{}.T_0P.R)
        throw FaultError(FaultCode::bad_configuration,
                         "sim.paper.tilt: the sheets lie on the conveyor, whose belt is level");
  }
}

PhysicsEngine read_engine(const Config& sim) {
  const auto engine = sim.choice("engine", PhysicsEngine::bullet,
                                 {{"bullet", PhysicsEngine::bullet}, {"mujoco", PhysicsEngine::mujoco}},
                                 {"", "which physics moves arms, pens, paper and plates"});
  if (engine == PhysicsEngine::mujoco && !has_mujoco())
    throw FaultError(
        FaultCode::bad_configuration,
        "sim.engine: this build has no MuJoCo; take \"bullet\", or build with it: ./run takes it from PyPI "
        "where MRROC_MUJOCO is not OFF");
  return engine;
}

/// What touches cubes and free bodies stands in Bullet only.
void check_engine(const WorldParameters& world) {
  if (world.engine != PhysicsEngine::mujoco) return;
  const bool grasps = std::ranges::any_of(
      world.arms, [](const ArmParameters& arm) { return arm.gripper.has_value() || arm.palm.has_value(); });
  if (world.cube || world.free_body || grasps)
    throw FaultError(
        FaultCode::bad_configuration,
        "sim.engine: \"mujoco\" has no cube, no free body, and no fingers or palms; take \"bullet\"");
}

/// Steps of 1 ms would damp springs of gears, and contacts would bear up to a half more than they do (docs/stability.md).
constexpr int kElasticSubsteps = 4;

bool have_elastic_gears(const WorldParameters& w) {
  return std::ranges::any_of(w.arms, [](const ArmParameters& arm) { return arm.elasticity.frequency > 0; });
}

/// Who put the cube into the hand closed its jaws on it, however large it is.
void close_on_cube(WorldParameters& w) {
  if (!w.cube) return;
  auto& jaws = w.arms[static_cast<std::size_t>(w.cube->held_by)].jaws;
  if (jaws) jaws->start += w.cube->edge - kCubeEdge;
}

}  // namespace

WorldParameters read_world(const Config& config) {
  WorldParameters w;
  w.engine = read_engine(config.section("sim"));
  w.solver_iterations = config.integer("sim.solver_iterations", w.solver_iterations, {10, 1000},
                                       {"", "of the solver of contacts"});
  std::vector<const robots::RobotType*> types;  // a conveyor is none unless the configuration says so
  std::ranges::copy_if(robots::catalogue(), std::back_inserter(types),
                       [](const robots::RobotType* type) { return !type->belt; });
  const auto keys = config.texts("robots.order", std::vector<std::string>{"arm1", "arm2"});
  for (const std::string& key : keys)
    w.arms.push_back(read_arm(config, key, types[std::min(w.arms.size(), types.size() - 1)]->name));
  check_belt(w);
  w.substeps = config.integer("sim.substeps", have_elastic_gears(w) ? kElasticSubsteps : w.substeps, {1, 16},
                              {"per step", "of the integration; by default 2, with elastic gears 4"});
  w.cube = read_cube(config, keys);
  close_on_cube(w);
  w.free_body = read_true_body(config);
  w.artefact = read_true_artefact(config);
  check_engine(w);
  return w;
}

}  // namespace mrroc::sim
