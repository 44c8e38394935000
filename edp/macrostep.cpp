#include "edp/macrostep.hpp"

#include <algorithm>
#include <cmath>

#include "base/representation.hpp"
#include "base/screw.hpp"
#include "edp/control_law.hpp"
#include "edp/deceleration.hpp"
#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

/// Velocities of the axes that are not force controlled.
Twist positional(const TaskFrameCommand& rows) {
  Twist v;
  for (const Axis a : kAxes) v[a] = behaving(rows[a]).velocity;
  return v;
}

Pose desired_pose(const ArmCommand& command, const Pose& now) {
  // The pose was checked with the command: it is there.
  const Pose given = pose_from_numbers(command.representation, command.pose).value_or(Pose{});
  return command.reference == Reference::relative ? now * given : given;
}

ValidationError place(const Robot& robot, const Pose& T_0W, const AxisVector& near, AxisPositions& result) {
  const InverseSolution s = robot.inverse(T_0W, near);
  if (!s.reached) return make_fault(FaultCode::unreachable_pose, "missing [m]", -1, s.missing);
  result = {s.joints, robot.motors_from_joints(s.joints)};
  return {};
}

/// How a macrostep that begins at rest is to end when no command follows: a slow one passes its goal a little and returns,
/// a fast one brakes before it. One that goes on with a motion keeps its speed and stops as ever.
/// @param T_0E  where E is at the end
void plan_end(const ArmCommand& command, const Beginning& begin, const Pose& T_0E, const MotionRules& rules,
              Macrostep& plan) {
  const int n = std::min(2 * plan.n_s, rules.stop_steps);
  if (begin.late) plan.approach.emplace(plan.n_s, n);
  if (!begin.at_rest || begin.late) return;
  const double time = plan.n_s * rules.dt;
  bool slow = command.n_Q <= command.n_s;  // the passive step would end any speed at once
  if (rules.position_known) {
    const double omega = angle_axis_from_rotation(begin.from.T_0E.R.transpose() * T_0E.R).norm() / time;
    slow = slow && (T_0E.p - begin.from.T_0E.p).norm() <= kSlow * time && omega <= kSlowTurn;
  } else {
    const AxisVector way = plan.goal->axes.motors - begin.from.axes.motors;
    slow = slow && way.cwiseAbs().maxCoeff() <= kSlowMotor * time;
  }
  if (slow)
    plan.stop_steps = std::min(kShortStop, rules.stop_steps);
  else
    plan.approach.emplace(plan.n_s, n);
}

ValidationError plan_mim(const ArmCommand& command, const Beginning& begin, const Pose& T_WE,
                         const MotionRules& rules, Macrostep& plan) {
  const SetPoint& from = begin.from;
  const Robot& robot = *rules.robot;
  const bool relative = command.reference == Reference::relative;
  AxisPositions to;
  switch (command.representation) {
    case Representation::motors:
      to.motors = axes_from_numbers(command.pose, robot.axes());
      if (relative) to.motors += begin.axes.motors;
      to.joints = robot.joints_from_motors(to.motors);
      break;
    case Representation::joints:
      to.joints = axes_from_numbers(command.pose, robot.axes());
      if (relative) to.joints += begin.axes.joints;
      to.motors = robot.motors_from_joints(to.joints);
      break;
    case Representation::frame:
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis: {
      const Pose T_0W = desired_pose(command, begin.T_0E) * T_WE.inverse();
      if (const ValidationError wrong = place(robot, T_0W, from.axes.joints, to)) return wrong;
      break;
    }
  }
  const double time = command.n_s * rules.dt;
  const Pose T_0W = rules.position_known ? robot.forward(to.joints) : Pose{};
  plan.goal = Goal{T_0W, to};
  if (begin.on_the_way && rules.position_known) {
    const Vector6 r = angle_axis_from_pose(from.T_0E.inverse() * T_0W * T_WE) / time;
    if (const ValidationError wrong = check_velocity(Twist::from(r.head<3>(), r.tail<3>()), rules.limits))
      return wrong;
  }
  plan_end(command, begin, T_0W * T_WE, rules, plan);
  if (rules.position_known) {
    const double stop_way = plan.approach ? 0 : stopping_way(rules.stop_steps) / command.n_s;
    if (const ValidationError wrong = check_range(robot, from.axes, to, stop_way)) return wrong;
    if (const ValidationError wrong = check_workspace(from.T_0E, T_0W * T_WE, rules.limits)) return wrong;
  }
  if (const ValidationError wrong = check_motor_speed(robot, from.axes.motors, to.motors, time)) return wrong;
  const AxisVector speed = (to.motors - from.axes.motors) / time;
  if (const ValidationError wrong =
          check_motor_acceleration(from.motor_increment / rules.dt, speed, rules.dt, rules.limits))
    return wrong;
  if (command.n_Q > command.n_s && !plan.approach)  // the passive step, in which the set point stands
    if (const ValidationError wrong =
            check_motor_acceleration(speed, AxisVector::Zero(robot.axes()), rules.dt, rules.limits))
      return wrong;
  plan.from = from.axes.motors;
  plan.to = to.motors;
  return {};
}

/// The step of velocity with which the macrostep begins, as far as it is commanded: along axes without force
/// control.
ValidationError check_first_step(const ArmCommand& command, const Twist& v_d, const SetPoint& from,
                                 const Pose& T_WE, const MotionRules& rules) {
  const Twist before = velocity_of_E(from, T_WE.inverse());
  Twist after = before;
  for (const Axis a : kAxes)
    if (const AxisCommand& row = command.frame[a]; row.b == Behaviour::unguarded)
      after[a] = command.mu == Interpolation::tcim_pose ? v_d[a] : row.velocity;
  return check_acceleration(before, after, rules.dt, rules.limits);
}

/// The step of velocity of the passive step, in which the set point stands, as far as it is commanded.
/// @param v_end commanded velocity in the last step before it
ValidationError check_passive_step(const ArmCommand& command, const Twist& v_end, const MotionRules& rules) {
  if (command.n_Q <= command.n_s) return {};
  Twist before;
  for (const Axis a : kAxes)
    if (command.frame[a].b == Behaviour::unguarded) before[a] = v_end[a];
  return check_acceleration(before, {}, rules.dt, rules.limits);
}

/// @return whether no axis follows a force
bool positional_only(const TaskFrameCommand& rows) {
  return std::ranges::all_of(kAxes, [&](Axis a) { return rows[a].b == Behaviour::unguarded; });
}

bool ends_at_a_pose(const ArmCommand& command) {
  return command.mu == Interpolation::mim ||
         (command.mu == Interpolation::tcim_pose && positional_only(command.frame));
}

ValidationError plan_tcim(const ArmCommand& command, const Beginning& begin, const Pose& T_WE,
                          const MotionRules& rules, Macrostep& plan) {
  const SetPoint& from = begin.from;
  const double time = command.n_s * rules.dt;
  Pose end;
  Twist v_d;    // along the path of TCIM-POSE
  Twist v_end;  // in E at the end
  if (command.mu == Interpolation::tcim_pose) {
    end = desired_pose(command, begin.T_0E);
    const Vector6 r = angle_axis_from_pose(from.T_0E.inverse() * end);
    v_d = Twist::from(r.head<3>() / time, r.tail<3>() / time);  // eq. (27)
    if (const ValidationError wrong = check_velocity(v_d, rules.limits)) return wrong;
    v_end = xi_star(end.R.transpose() * from.T_0E.R, v_d);
  } else {
    end = from.T_0E * exp_screw(positional(command.frame), time);
    v_end = positional(command.frame);
  }
  AxisPositions to;
  const Pose T_0W = end * T_WE.inverse();
  if (const ValidationError wrong = place(*rules.robot, T_0W, from.axes.joints, to)) return wrong;
  if (const ValidationError wrong = check_range(*rules.robot, from.axes, to, 0)) return wrong;
  if (const ValidationError wrong = check_workspace(from.T_0E, end, rules.limits)) return wrong;
  if (const ValidationError wrong = check_first_step(command, v_d, from, T_WE, rules)) return wrong;
  if (ends_at_a_pose(command)) {
    plan.goal = Goal{T_0W, to};
    plan_end(command, begin, end, rules, plan);
  }
  if (!plan.approach)
    if (const ValidationError wrong = check_passive_step(command, v_end, rules)) return wrong;
  plan.frame = command.frame;
  plan.v_d = xi_star(from.T_0E.R, v_d);
  return {};
}

ValidationError plan_one(const ArmCommand& command, const Beginning& begin, const Pose& T_WE,
                         const MotionRules& rules, Macrostep& plan) {
  plan = {};
  plan.mu = command.mu;
  plan.n_s = command.n_s;
  plan.stop_steps = rules.stop_steps;
  return command.mu == Interpolation::mim ? plan_mim(command, begin, T_WE, rules, plan)
                                          : plan_tcim(command, begin, T_WE, rules, plan);
}

/// Plans a command that the robot could execute if it were not for the way that is left before it: over more steps.
/// @param wrong  why it cannot be executed in its own  @return why it is refused
ValidationError plan_late(const ArmCommand& command, const Beginning& begin, const Pose& T_WE,
                          const MotionRules& rules, const ValidationError& wrong, Macrostep& plan) {
  const bool hard = wrong->code == FaultCode::too_fast || wrong->code == FaultCode::excessive_acceleration;
  if (!begin.on_the_way || !hard || !ends_at_a_pose(command)) return wrong;
  Beginning at_goal = begin;
  at_goal.from.T_0E = begin.T_0E;
  at_goal.from.axes = begin.axes;
  if (plan_one(command, at_goal, T_WE, rules, plan)) return wrong;
  ArmCommand later = command;
  later.n_s = later.n_Q = static_cast<std::uint16_t>(command.n_s + kCatchUp);
  Beginning late = begin;
  late.late = true;
  return plan_one(later, late, T_WE, rules, plan);
}

}  // namespace

std::optional<Fault> plan_macrostep(const ArmCommand& command, const Beginning& begin, const Pose& T_WE,
                                    const MotionRules& rules, Macrostep& plan) noexcept {
  Macrostep next;
  ValidationError wrong = plan_one(command, begin, T_WE, rules, next);
  if (wrong) wrong = plan_late(command, begin, T_WE, rules, wrong, next);
  if (!wrong) plan = next;
  return wrong;
}

}  // namespace mrroc::edp
