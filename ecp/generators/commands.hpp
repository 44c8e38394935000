// Effector commands y_ce for the rows of a Move table.
#pragma once
#include "base/effector_command.hpp"
#include "base/pose.hpp"
#include "ecp/generators/trajectory.hpp"

namespace mrroc::ecp {

/// @return SET_GET ARM
[[nodiscard]] constexpr EffectorCommand move_arm(const ArmCommand& arm) {
  EffectorCommand command{.instruction = Instruction::set_get};
  command.set = static_cast<std::uint8_t>(Part::arm);
  command.get = static_cast<std::uint8_t>(Part::arm);
  command.arm = arm;
  return command;
}

/// @return SET_GET ARM, TCIM-VELOCITY, with these rows of the task frame
[[nodiscard]] constexpr EffectorCommand move_arm(const TaskFrameCommand& frame, const Pacing& pacing = {}) {
  ArmCommand arm;
  arm.frame = frame;
  arm.n_s = pacing.n_s;
  arm.n_Q = pacing.n_Q;
  return move_arm(arm);
}

/// @return nothing: the arm comes to rest and holds, which biasing and changing the force tool need
[[nodiscard]] constexpr EffectorCommand rest() { return {}; }

/// @return SET force_bias: the adjusted force is zero from now on; at rest and without contact
[[nodiscard]] constexpr EffectorCommand bias_force() {
  EffectorCommand command{.instruction = Instruction::set};
  command.set = static_cast<std::uint8_t>(Part::force_bias);
  return command;
}

/// @return SET ROBOT_MODEL FORCE_TOOL, which biases anew; at rest and without contact
/// @param w  weight of everything beyond the sensor [N]  @param P  its mass centre W_G P [m]
[[nodiscard]] EffectorCommand change_force_tool(double w, const Vector3& P);

/// @return the command with SET ROBOT_MODEL TOOL added; the wrist stays where it is
/// @param T_WE  task frame in the wrist
[[nodiscard]] EffectorCommand with_tool(EffectorCommand command, const Pose& T_WE);

/// f_ce of the transparent behaviour (MS 36): the coordinator's order, as it is. A late one is kept back: the
/// arm comes to rest and holds until an order comes.
template <class X>
[[nodiscard]] EffectorCommand copied_order(const X& x) {
  return x.T.late ? EffectorCommand{} : move_arm(x.T.arm);
}

}  // namespace mrroc::ecp
