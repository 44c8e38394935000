// Commands that must not be executed.
#pragma once
#include <limits>

#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {

/// The damage to a command.
struct Damage {
  double bad{};               ///< a number that is nowhere right
  Axis axis{};                ///< of the task frame
  std::size_t number{};       ///< of a motor or joint
  std::uint8_t enumerator{};  ///< of no enumeration
  int kind{};                 ///< 0 to 24
};

inline Damage random_damage(std::mt19937_64& random) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array kBad{kNan, kInf, -kInf, 1e300, -1e300, 1e9, -1e9};
  Damage d;
  d.bad = kBad[random() % kBad.size()];
  d.axis = kAxes[random() % 6];
  d.number = random() % 6;
  d.enumerator = static_cast<std::uint8_t>(8 + random() % 240);
  d.kind = pick(random, 25);
  return d;
}

/// Makes the instruction, the steps, a field of a question or one of a model wrong. @param d  of kind 0 to 2, 11, 12, or
/// 18 to 24
inline void damage_model(std::mt19937_64& random, EffectorCommand& c, const Damage& d) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  switch (d.kind) {
    case 0:
      c.instruction = static_cast<Instruction>(d.enumerator);
      break;
    case 1:
      c.set = static_cast<std::uint8_t>(c.set | 16u << (random() % 4));
      break;
    case 2:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(8u << (random() % 5));
      break;
    case 11:
      c.arm.n_s = random() % 2 ? 0 : static_cast<std::uint16_t>(kMaxSteps + 1 + random() % 60'000);
      break;
    case 12:
      c.arm.n_Q = random() % 2 ? 0 : static_cast<std::uint16_t>(c.arm.n_s + 2 + random() % 60'000);
      break;
    case 18:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::arm);
      c.get_representation = static_cast<Representation>(d.enumerator);
      break;
    case 19:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::robot_model);
      c.get_tool_representation = random() % 2 ? static_cast<Representation>(d.enumerator)
                                               : static_cast<Representation>(random() % 2);
      break;
    case 20:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::io);
      c.feedback = static_cast<Feedback>(d.enumerator);
      break;
    case 21:
      c.set = static_cast<std::uint8_t>(c.set | static_cast<unsigned>(Part::robot_model));
      c.robot_model.set_kinematic_model = true;
      c.robot_model.kinematic_model = static_cast<std::uint16_t>(1 + random() % 65'000);
      break;
    case 22:
      c.set = static_cast<std::uint8_t>(c.set | static_cast<unsigned>(Part::robot_model));
      c.robot_model.set_servo_algorithm = static_cast<std::uint8_t>(1u << FakeArm::kAxes << (random() % 2));
      break;
    case 23:
      c.arm.gripper = random() % 2 ? kNan : kInf;
      break;
    default:
      c.set = static_cast<std::uint8_t>(c.set | static_cast<unsigned>(Part::robot_model));
      c.robot_model.set_tool = random() % 2;
      c.robot_model.set_force_tool = !c.robot_model.set_tool;
      c.robot_model.tool = numbers_from_pose(Representation::frame, Pose{});
      c.robot_model.tool[random() % 12] += random() % 2 ? d.bad : 5;
      (random() % 2 ? c.robot_model.weight : c.robot_model.mass_centre[random() % 3]) = d.bad;
  }
}

/// Makes the behaviour of one axis of the task frame wrong. @param d  of kind 6 to 10
inline void damage_task_frame(std::mt19937_64& random, EffectorCommand& c, const Damage& d) {
  c.arm.mu = Interpolation::tcim_velocity;
  AxisCommand& row = c.arm.frame[d.axis];
  row.b = random() % 2 ? Behaviour::guarded : Behaviour::contact;
  switch (d.kind) {
    case 6:
      row.b = static_cast<Behaviour>(d.enumerator);
      break;
    case 7:
      row.b = Behaviour::contact;
      row.force = d.bad;
      break;
    case 8:
      row.b = Behaviour::unguarded;
      row.velocity = d.bad;
      break;
    case 9:
      row.inertia = random() % 2 ? d.bad : -1e-3;
      break;
    default:
      row.mobility = random() % 2 ? d.bad : -1e-3;
  }
}

/// Makes the position to go to wrong, or how it is told. @param d  of kind 4, 5, or 13 to 17
inline void damage_pose(std::mt19937_64& random, EffectorCommand& c, const Damage& d) {
  const auto in_pose = [&](Representation r) {
    c.arm.mu = random() % 2 || per_axis(r) ? Interpolation::mim : Interpolation::tcim_pose;
    c.arm.representation = r;
    c.arm.pose = per_axis(r) ? PoseNumbers{} : numbers_from_pose(r, Pose{});
    c.arm.reference = Reference::relative;
  };
  switch (d.kind) {
    case 4:
      in_pose(Representation::frame);
      c.arm.representation = static_cast<Representation>(d.enumerator);
      break;
    case 5:
      in_pose(Representation::frame);
      c.arm.reference = static_cast<Reference>(d.enumerator);
      break;
    case 13:
      in_pose(Representation::motors);
      c.arm.pose[d.number] = d.bad;
      break;
    case 14:
      in_pose(Representation::joints);
      c.arm.pose[d.number] = d.bad;
      break;
    case 15:
      in_pose(Representation::frame);
      c.arm.pose[random() % 12] += random() % 2 ? d.bad : 5;
      break;
    case 16:
      in_pose(Representation::xyz_angle_axis);
      c.arm.pose[random() % 3] = d.bad;
      break;
    default:
      c.arm.mu = Interpolation::tcim_pose;
      c.arm.representation = Representation::motors;
  }
}

/// Makes one field of a command wrong. Every kind of damage makes it illegal in every state.
inline void damage(std::mt19937_64& random, EffectorCommand& c) {
  const Damage d = random_damage(random);
  switch (d.kind) {
    case 3:
      c.arm.mu = static_cast<Interpolation>(d.enumerator);
      break;
    case 6:
    case 7:
    case 8:
    case 9:
    case 10:
      damage_task_frame(random, c, d);
      break;
    case 4:
    case 5:
    case 13:
    case 14:
    case 15:
    case 16:
    case 17:
      damage_pose(random, c, d);
      break;
    default:
      damage_model(random, c, d);
  }
}

}  // namespace mrroc::edp::test
