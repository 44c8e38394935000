// Initial computations of a macrostep (MG 8.1.1): makes the input of the step generator from a SET ARM
// command and the set point.
#pragma once
#include <optional>

#include "base/effector_command.hpp"
#include "edp/approach.hpp"
#include "edp/limits.hpp"
#include "edp/robot.hpp"
#include "edp/set_point.hpp"

namespace mrroc::edp {

/// Constants of a macrostep.
struct Macrostep {
  Interpolation mu{Interpolation::tcim_velocity};  ///< MIM or TCIM: which of the fields below count
  int n_s{1};                                      ///< steps of motion
  TaskFrameCommand frame;    ///< TCIM: rows of E; their velocities count in TCIM-VELOCITY
  Twist v_d;                 ///< TCIM-POSE: eq. (27), in the orientation of the base [m/s], [rad/s]
  AxisVector from;           ///< MIM: motors at the start [rad]
  AxisVector to;             ///< MIM: motors at the end [rad]
  std::optional<Goal> goal;  ///< where the motion ends when no command follows; none: it has no such place
  std::optional<Approach> approach;  ///< brakes before the goal; none: the speed is constant over n_s
  int stop_steps{1};                 ///< of the stop when no command follows a macrostep of constant speed
};

/// Initial state of a macrostep.
struct Beginning {
  SetPoint from;  ///< set point at the start, T_0E with the tool of the macrostep
  Pose
      T_0E;  ///< that relative poses count from: from.T_0E, or the goal that the set point is still on its way to
  AxisPositions axes;  ///< that relative motors and joints count from
  bool on_the_way{};   ///< the set point is still on its way to that goal
  bool late{};         ///< what was left of that way is planned over more steps than the command has
  bool at_rest{};      ///< the arm rests: the macrostep does not go on with a motion
};

/// Constants that a macrostep is planned with.
struct MotionRules {
  const Robot* robot;  ///< never null
  Limits limits;       ///< no set point leaves them
  double dt;           ///< [s]
  int stop_steps;      ///< steps of a stop
  bool position_known{
      true};  ///< false: motors count from an unknown place. Only relative motor positions can
              ///< be planned, and no range, joint or pose means anything
};

/// Plans a macrostep and checks that its end is reachable, within the limits of joints and motors, and not
/// too far for its steps. Pure and real-time safe.
/// @param command  content checked before (edp/guard.hpp)
/// @param begin    where it begins
/// @param T_WE     tool
/// @param plan     the plan, changed only when nothing is wrong
/// @return why it is refused
[[nodiscard]] std::optional<Fault> plan_macrostep(const ArmCommand& command, const Beginning& begin,
                                                  const Pose& T_WE, const MotionRules& rules,
                                                  Macrostep& plan) noexcept;

}  // namespace mrroc::edp
