#include "ecp/generators/commands.hpp"

#include "base/representation.hpp"

namespace mrroc::ecp {

EffectorCommand change_force_tool(double w, const Vector3& P) {
  EffectorCommand command{.instruction = Instruction::set};
  command.set = static_cast<std::uint8_t>(Part::robot_model);
  command.robot_model.set_force_tool = true;
  command.robot_model.weight = w;
  command.robot_model.mass_centre = {P.x(), P.y(), P.z()};
  return command;
}

EffectorCommand with_tool(EffectorCommand command, const Pose& T_WE) {
  if (command.instruction == Instruction::keep) command.instruction = Instruction::set;
  command.set |= static_cast<std::uint8_t>(Part::robot_model);
  command.robot_model.set_tool = true;
  command.robot_model.tool_representation = Representation::frame;
  command.robot_model.tool = numbers_from_pose(Representation::frame, T_WE);
  return command;
}

}  // namespace mrroc::ecp
