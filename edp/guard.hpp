// Checks of commands and of set points. Pure functions: nothing is executed that they have not passed.
#pragma once
#include <optional>
#include <string_view>

#include "base/effector_command.hpp"
#include "edp/limits.hpp"
#include "edp/robot.hpp"
#include "edp/set_point.hpp"

namespace mrroc::edp {

/// Every check returns what is wrong - with axis, value and limit where there are any - or nothing. An axis
/// is one of the task frame, x y z ax ay az = 0..5, in checks of commands and velocities; a motor in checks
/// of positions and motor speeds. Real-time safe.
using Objection = std::optional<Fault>;

/// @return a fault made of its parts. Real-time safe
[[nodiscard]] Fault make_fault(FaultCode code, std::string_view text, int axis = -1, double value = 0,
                               double limit = 0) noexcept;

/// Instruction, masks and feedback: the numbers that must mean something whatever the instruction.
[[nodiscard]] Objection check_form(const EffectorCommand& command) noexcept;

/// Content of SET ARM without the robot: steps, enumerators, finite numbers, proper poses, rows of the task
/// frame within the limits. What the command does not use is not looked at.
/// @param axes of the robot
[[nodiscard]] Objection check_arm(const ArmCommand& command, int axes, const Limits& limits) noexcept;

/// Content of SET ROBOT_MODEL.
[[nodiscard]] Objection check_model(const RobotModel& model, const Limits& limits) noexcept;

/// Lengths of both parts of a velocity of E.
[[nodiscard]] Objection check_velocity(const Twist& v, const Limits& limits) noexcept;

/// Joint and motor limits of a motion, and of the stop that it may have to be followed by. An axis that is
/// out of its limits already - after a reset, say - may move towards them, not farther away.
/// @param stop_way way of the stop, as a multiple of the motion from `from` to `to`; 0: no stop follows
[[nodiscard]] Objection check_range(const Robot& robot, const AxisPositions& from, const AxisPositions& to,
                                    double stop_way) noexcept;

/// Motor speeds of a motion. @param time that it takes [s]
[[nodiscard]] Objection check_motor_speed(const Robot& robot, const AxisVector& from, const AxisVector& to,
                                          double time) noexcept;

}  // namespace mrroc::edp
