// Initial computations of a macrostep (MG 8.1.1): from a SET ARM command and the set point to what the step
// generator needs.
#pragma once
#include <optional>

#include "base/effector_command.hpp"
#include "edp/limits.hpp"
#include "edp/robot.hpp"
#include "edp/set_point.hpp"

namespace mrroc::edp {

/// What stays constant during a macrostep.
struct Macrostep {
  Interpolation mu{Interpolation::tcim_velocity};  ///< MIM or TCIM: which of the fields below count
  int n_s{1};                                      ///< steps of motion
  TaskFrameCommand frame;  ///< TCIM: rows of E; their velocities count in TCIM-VELOCITY
  Twist v_d;               ///< TCIM-POSE: eq. (27), in the orientation of the base [m/s], [rad/s]
  AxisVector from;         ///< MIM: motors at the start [rad]
  AxisVector to;           ///< MIM: motors at the end [rad]
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
/// @param from     set point at the start
/// @param T_WE     tool
/// @param plan     the plan, changed only when nothing is wrong
/// @return why it is refused
[[nodiscard]] std::optional<Fault> plan_macrostep(const ArmCommand& command, const SetPoint& from,
                                                  const Pose& T_WE, const MotionRules& rules,
                                                  Macrostep& plan) noexcept;

}  // namespace mrroc::edp
