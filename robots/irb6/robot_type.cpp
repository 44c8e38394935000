#include "robots/irb6/robot_type.hpp"

#include <numbers>

#include "robots/irb6/arm.hpp"
#include "robots/irb6/homing.hpp"

namespace mrroc::irb6 {
namespace {

using std::numbers::pi;

// Motor T, counted from the column; motor V, the next one, turns along with it.
constexpr int kAxisT = 3;

// Data of one drive, known or estimated. docs/plant.md tells where the figures come from.
struct PlantDrive {
  double time_constant;  // that its regulator was designed for [s]
  double rotor_inertia;  // [kg m^2]
  double load_inertia;   // of the links, through the gear, at the shaft, while drawing [kg m^2]
  double friction;       // [N m]
  double brake_torque;   // [N m]
};

constexpr PlantDrive kTrackDrive{0.056, 1.5e-4, 6.5e-5, 0.015, 0.6};
constexpr std::array<PlantDrive, kArmAxes> kArmDrives{{
    {0.056, 1.5e-4, 5.4e-4, 0.015, 0.6},
    {0.046, 1.5e-4, 2.4e-4, 0.015, 0.6},
    {0.042, 1.5e-4, 1.8e-4, 0.015, 0.6},
    {0.028, 1.5e-4, 4.1e-5, 0.015, 0.6},
    {0.023, 1.5e-5, 2.0e-5, 0.003, 0.1},
    {0.026, 1.5e-5, 1.0e-7, 0.003, 0.1},
}};

// The resistance at which speed follows voltage with the time constant that the regulator cancels.
robots::MotorParameters motor(const PlantDrive& d, const AxisTable& axis) {
  robots::MotorParameters m;
  m.resistance = d.time_constant * m.torque_constant * m.torque_constant / (d.rotor_inertia + d.load_inertia);
  m.rotor_inertia = d.rotor_inertia;
  m.friction = d.friction;
  m.brake_torque = d.brake_torque;
  m.current_limit = axis.properties.servo.drive.current_limit;
  return m;
}

// The pitch links are driven by absolute angles, so a rotor
// belongs to the link alone; the product term between T and V is neglected (docs/plant.md).
AxisVector rotor_inertia(const edp::Robot& robot, std::span<const robots::MotorParameters> motors,
                         const AxisVector& joints) {
  const AxisMatrix J = robot.motors_per_joints(joints);
  AxisVector inertia(robot.axes());
  for (int k = 0; k < robot.axes(); ++k)
    inertia[k] = motors[static_cast<std::size_t>(k)].rotor_inertia * J(k, k) * J(k, k);
  const int T = robot.axes() - kArmAxes + kAxisT;
  const int V = T + 1;
  inertia[T] += motors[static_cast<std::size_t>(V)].rotor_inertia * J(V, T) * J(V, T);
  return inertia;
}

std::vector<robots::LinkLength> lengths_of(const ArmParameters& arm) {
  return {{"upper_arm", arm.lengths.a2}, {"T", arm.lengths.a3}, {"V", arm.lengths.d5}};
}

robots::RobotType type_of(const ArmParameters& arm) {
  const Arm kernel(arm);
  robots::RobotType t;
  t.name = arm.name;
  t.program = "edp_irb6";
  t.parameter_sets = {"nominal", "calibrated"};
  t.driver = {.T_WS = kernel.sensor_in_wrist(),
              .T_WE = kernel.tool_in_wrist(),
              .tool_weight = arm.tool_weight,
              .tool_mass_centre = arm.tool_mass_centre,
              .force_limit = arm.force_limit,
              .homing = homing_of(arm)};
  t.rotor_inertia = rotor_inertia;
  if (arm.on_track) t.motors.push_back(motor(kTrackDrive, arm.axes[0]));
  for (const PlantDrive& d : kArmDrives) t.motors.push_back(motor(d, arm.axes[t.motors.size()]));
  if (arm.on_track) t.start.push_back(0);
  t.start.insert(t.start.end(), {0, -pi / 2, 0, 0, 3 * pi / 2, pi / 2});
  t.starts_above_sheet = true;
  return t;
}

}  // namespace

const robots::RobotType& postument() {
  static const robots::RobotType type = [] {
    robots::RobotType t = type_of(kPostument);
    t.make = [](int model) -> std::unique_ptr<edp::Robot> { return make_arm(kPostument.name, model); };
    t.lengths = [](int model) { return lengths_of(model % 2 == 0 ? kPostument : kPostumentCalibrated); };
    t.urdf = postument_urdf();
    t.T_UB.p = {0, 2.1, 0};
    return t;
  }();
  return type;
}

const robots::RobotType& track() {
  static const robots::RobotType type = [] {
    robots::RobotType t = type_of(kTrack);
    t.make = [](int model) -> std::unique_ptr<edp::Robot> { return make_arm(kTrack.name, model); };
    t.track_rules = {"kept", "last_axis_kept", "column_kept"};
    t.lengths = [](int model) { return lengths_of(model % 2 == 0 ? kTrack : kTrackCalibrated); };
    t.urdf = track_urdf();
    return t;
  }();
  return type;
}

}  // namespace mrroc::irb6
