#include <array>

#include "sim/world.hpp"

namespace mrroc::sim {
namespace {

// What is known or estimated of one drive. docs/plant.md tells where the figures come from.
struct Drive {
  double time_constant;  // that its regulator was designed for [s]
  double rotor_inertia;  // [kg m^2]
  double load_inertia;   // of the links, through the gear, at the shaft, while drawing [kg m^2]
  double friction;       // [N m]
  double brake_torque;   // [N m]
};

constexpr Drive kTrack{0.056, 1.5e-4, 6.5e-5, 0.015, 0.6};
constexpr std::array<Drive, 6> kArm{{
    {0.056, 1.5e-4, 5.4e-4, 0.015, 0.6},
    {0.046, 1.5e-4, 2.4e-4, 0.015, 0.6},
    {0.042, 1.5e-4, 1.8e-4, 0.015, 0.6},
    {0.028, 1.5e-4, 4.1e-5, 0.015, 0.6},
    {0.023, 1.5e-5, 2.0e-5, 0.003, 0.1},
    {0.026, 1.5e-5, 1.0e-7, 0.003, 0.1},
}};

// The resistance at which speed follows voltage with the time constant that the regulator cancels.
MotorParameters motor(const Drive& d) {
  MotorParameters m;
  m.resistance = d.time_constant * m.torque_constant * m.torque_constant / (d.rotor_inertia + d.load_inertia);
  m.rotor_inertia = d.rotor_inertia;
  m.friction = d.friction;
  m.brake_torque = d.brake_torque;
  return m;
}

}  // namespace

ArmParameters arm_parameters(ArmModel model) {
  ArmParameters p;
  p.model = model;
  if (model == ArmModel::irb6_postument) p.T_UB.p = {0, 2.1, 0};
  if (model == ArmModel::irb6_track) p.motors.push_back(motor(kTrack));
  for (const Drive& d : kArm) p.motors.push_back(motor(d));
  return p;
}

ArmParameters arm_parameters(const robots::Kind& kind) {
  ArmParameters p;
  p.model = ArmModel::other;
  p.kind = &kind;
  p.motors = kind.motors;
  p.start = kind.start;
  return p;
}

}  // namespace mrroc::sim
