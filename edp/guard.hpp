// Checks commands and set points before they are executed. Pure functions.
#pragma once
#include <array>
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
using ValidationError = std::optional<Fault>;

/// @return a fault made of its parts. Real-time safe
[[nodiscard]] Fault make_fault(FaultCode code, std::string_view text, int axis = -1, double value = 0,
                               double limit = 0) noexcept;

/// Instruction, masks and feedback: the numbers that must mean something whatever the instruction.
[[nodiscard]] ValidationError check_form(const EffectorCommand& command) noexcept;

/// Content of SET ARM without the robot: steps, enumerators, finite numbers, proper poses, rows of the task
/// frame within the limits. What the command does not use is not looked at.
/// @param axes of the robot
[[nodiscard]] ValidationError check_arm(const ArmCommand& command, int axes, const Limits& limits) noexcept;

/// Content of SET ROBOT_MODEL: only the parts that are marked.
[[nodiscard]] ValidationError check_model(const RobotModel& model, const Robot& robot,
                                          const Limits& limits) noexcept;

/// Lengths of both parts of a velocity of E.
[[nodiscard]] ValidationError check_velocity(const Twist& v, const Limits& limits) noexcept;

/// Joint and motor limits of a motion, and of the stop that it may have to be followed by. An axis that is
/// out of its limits already - after a reset, say - may move towards them, not farther away.
/// @param stop_way way of the stop, as a multiple of the motion from `from` to `to`; 0: no stop follows
[[nodiscard]] ValidationError check_range(const Robot& robot, const AxisPositions& from,
                                          const AxisPositions& to, double stop_way) noexcept;

/// Ranges and largest motions of all axes side by side: nearly every step is legal, and this tells it in one pass.
/// Ranges of plainly legal axes; anything else is left to the checks, which name the error.
class AxisRanges {
 public:
  /// @param dt duration of a step [s] @param motor_acceleration largest one [rad/s^2]
  AxisRanges(const Robot& robot, double dt, double motor_acceleration) noexcept;

  /// @return whether all joints and motors are in their ranges; false for NaN
  [[nodiscard]] bool contain(const AxisPositions& axes) const noexcept;
  /// @param before, after motions of the motors in two steps that follow one another [rad]
  /// @return whether speeds and accelerations of all motors are allowed; false for NaN
  [[nodiscard]] bool allow(const AxisVector& before, const AxisVector& after) const noexcept;

 private:
  using Numbers = std::array<double, kMaxAxes>;
  int axes_;
  Numbers motor_lower_{}, motor_upper_{}, joint_lower_{}, joint_upper_{};
  Numbers most_{};      // motion in a step [rad]
  double most_change_;  // of that from step to step [rad]
};

/// Motor speeds of a motion. @param time that it takes [s]
[[nodiscard]] ValidationError check_motor_speed(const Robot& robot, const AxisVector& from,
                                                const AxisVector& to, double time) noexcept;

/// Change of the motors' speeds in one step.
/// @param before, after  speeds [rad/s] @param dt [s]
[[nodiscard]] ValidationError check_motor_acceleration(const AxisVector& before, const AxisVector& after,
                                                       double dt, const Limits& limits) noexcept;

/// Change of a velocity in one step, both parts. @param dt [s]
[[nodiscard]] ValidationError check_acceleration(const Twist& before, const Twist& after, double dt,
                                                 const Limits& limits) noexcept;

/// Whether E stays in its workspace. From outside it may come nearer, not go farther away.
[[nodiscard]] ValidationError check_workspace(const Pose& from, const Pose& to,
                                              const Limits& limits) noexcept;

/// Whether a motion pushes farther along or about an axis with more contact force than is allowed; away from
/// the contact every motion is free. @param F_a adjusted force in E @param v velocity of E, in E
[[nodiscard]] ValidationError check_contact_force(const Wrench& F_a, const Twist& v,
                                                  const Limits& limits) noexcept;

}  // namespace mrroc::edp
