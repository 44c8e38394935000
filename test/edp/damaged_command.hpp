// Commands that must not be executed.
#pragma once
#include <limits>

#include "test/edp/random_command.hpp"

namespace mrroc::edp::test {

/// Makes one field of a command wrong. Every kind of damage makes it illegal in every state.
inline void damage(std::mt19937_64& random, EffectorCommand& c) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  constexpr std::array kBad{kNan, kInf, -kInf, 1e300, -1e300, 1e9, -1e9};
  const double bad = kBad[random() % kBad.size()];
  const auto axis = kAxes[random() % 6];
  const auto number = random() % 6;
  const auto enumerator = static_cast<std::uint8_t>(8 + random() % 240);
  const auto in_tcim = [&] {
    c.arm.mu = Interpolation::tcim_velocity;
    c.arm.frame[axis].b = random() % 2 ? Behaviour::guarded : Behaviour::contact;
  };
  const auto in_pose = [&](Representation r) {
    c.arm.mu = random() % 2 || per_axis(r) ? Interpolation::mim : Interpolation::tcim_pose;
    c.arm.representation = r;
    c.arm.pose = per_axis(r) ? PoseNumbers{} : numbers_from_pose(r, Pose{});
    c.arm.reference = Reference::relative;
  };
  switch (pick(random, 25)) {
    case 0:
      c.instruction = static_cast<Instruction>(enumerator);
      break;
    case 1:
      c.set = static_cast<std::uint8_t>(c.set | 16u << (random() % 4));
      break;
    case 2:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(8u << (random() % 5));
      break;
    case 3:
      c.arm.mu = static_cast<Interpolation>(enumerator);
      break;
    case 4:
      in_pose(Representation::frame);
      c.arm.representation = static_cast<Representation>(enumerator);
      break;
    case 5:
      in_pose(Representation::frame);
      c.arm.reference = static_cast<Reference>(enumerator);
      break;
    case 6:
      in_tcim();
      c.arm.frame[axis].b = static_cast<Behaviour>(enumerator);
      break;
    case 7:
      in_tcim();
      c.arm.frame[axis].b = Behaviour::contact;
      c.arm.frame[axis].force = bad;
      break;
    case 8:
      in_tcim();
      c.arm.frame[axis].b = Behaviour::unguarded;
      c.arm.frame[axis].velocity = bad;
      break;
    case 9:
      in_tcim();
      c.arm.frame[axis].inertia = random() % 2 ? bad : -1e-3;
      break;
    case 10:
      in_tcim();
      c.arm.frame[axis].mobility = random() % 2 ? bad : -1e-3;
      break;
    case 11:
      c.arm.n_s = random() % 2 ? 0 : static_cast<std::uint16_t>(kMaxSteps + 1 + random() % 60'000);
      break;
    case 12:
      c.arm.n_Q = random() % 2 ? 0 : static_cast<std::uint16_t>(c.arm.n_s + 2 + random() % 60'000);
      break;
    case 13:
      in_pose(Representation::motors);
      c.arm.pose[number] = bad;
      break;
    case 14:
      in_pose(Representation::joints);
      c.arm.pose[number] = bad;
      break;
    case 15:
      in_pose(Representation::frame);
      c.arm.pose[random() % 12] += random() % 2 ? bad : 5;
      break;
    case 16:
      in_pose(Representation::xyz_angle_axis);
      c.arm.pose[random() % 3] = bad;
      break;
    case 17:
      c.arm.mu = Interpolation::tcim_pose;
      c.arm.representation = Representation::motors;
      break;
    case 18:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::arm);
      c.get_representation = static_cast<Representation>(enumerator);
      break;
    case 19:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::robot_model);
      c.get_tool_representation =
          random() % 2 ? static_cast<Representation>(enumerator) : static_cast<Representation>(random() % 2);
      break;
    case 20:
      c.instruction = Instruction::set_get;
      c.get = static_cast<std::uint8_t>(Part::io);
      c.feedback = static_cast<Feedback>(enumerator);
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
      c.robot_model.tool[random() % 12] += random() % 2 ? bad : 5;
      (random() % 2 ? c.robot_model.weight : c.robot_model.mass_centre[random() % 3]) = bad;
  }
}

}  // namespace mrroc::edp::test
