#include "edp/macrostep.hpp"

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

Objection place(const Robot& robot, const Pose& T_0W, const AxisVector& near, AxisPositions& result) {
  const InverseSolution s = robot.inverse(T_0W, near);
  if (!s.reached) return make_fault(FaultCode::unreachable_pose, "missing [m]", -1, s.missing);
  result = {s.joints, robot.motors_from_joints(s.joints)};
  return {};
}

Objection plan_mim(const ArmCommand& command, const SetPoint& from, const Pose& T_WE,
                   const MotionRules& rules, Macrostep& plan) {
  const Robot& robot = *rules.robot;
  const bool relative = command.reference == Reference::relative;
  AxisPositions to;
  switch (command.representation) {
    case Representation::motors:
      to.motors = axes_from_numbers(command.pose, robot.axes());
      if (relative) to.motors += from.axes.motors;
      to.joints = robot.joints_from_motors(to.motors);
      break;
    case Representation::joints:
      to.joints = axes_from_numbers(command.pose, robot.axes());
      if (relative) to.joints += from.axes.joints;
      to.motors = robot.motors_from_joints(to.joints);
      break;
    case Representation::frame:
    case Representation::xyz_euler_zyz:
    case Representation::xyz_angle_axis: {
      const Pose T_0W = desired_pose(command, from.T_0E) * T_WE.inverse();
      if (const Objection wrong = place(robot, T_0W, from.axes.joints, to)) return wrong;
      break;
    }
  }
  const double time = command.n_s * rules.dt;
  if (rules.position_known) {
    const double stop_way = stopping_way(rules.stop_steps) / command.n_s;
    if (const Objection wrong = check_range(robot, from.axes, to, stop_way)) return wrong;
    if (const Objection wrong = check_workspace(from.T_0E, robot.forward(to.joints) * T_WE, rules.limits))
      return wrong;
  }
  if (const Objection wrong = check_motor_speed(robot, from.axes.motors, to.motors, time)) return wrong;
  const AxisVector speed = (to.motors - from.axes.motors) / time;
  if (const Objection wrong =
          check_motor_acceleration(from.motor_increment / rules.dt, speed, rules.dt, rules.limits))
    return wrong;
  if (command.n_Q > command.n_s)  // the passive step, in which the set point stands
    if (const Objection wrong =
            check_motor_acceleration(speed, AxisVector::Zero(robot.axes()), rules.dt, rules.limits))
      return wrong;
  plan.from = from.axes.motors;
  plan.to = to.motors;
  return {};
}

/// The step of velocity with which the macrostep begins, as far as it is commanded: along axes without force
/// control.
Objection check_first_step(const ArmCommand& command, const Twist& v_d, const SetPoint& from,
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
Objection check_passive_step(const ArmCommand& command, const Twist& v_end, const MotionRules& rules) {
  if (command.n_Q <= command.n_s) return {};
  Twist before;
  for (const Axis a : kAxes)
    if (command.frame[a].b == Behaviour::unguarded) before[a] = v_end[a];
  return check_acceleration(before, {}, rules.dt, rules.limits);
}

Objection plan_tcim(const ArmCommand& command, const SetPoint& from, const Pose& T_WE,
                    const MotionRules& rules, Macrostep& plan) {
  const double time = command.n_s * rules.dt;
  Pose end;
  Twist v_d;    // along the path of TCIM-POSE
  Twist v_end;  // in E at the end
  if (command.mu == Interpolation::tcim_pose) {
    end = desired_pose(command, from.T_0E);
    const Vector6 r = angle_axis_from_pose(from.T_0E.inverse() * end);
    v_d = Twist::from(r.head<3>() / time, r.tail<3>() / time);  // eq. (27)
    if (const Objection wrong = check_velocity(v_d, rules.limits)) return wrong;
    v_end = xi_star(end.R.transpose() * from.T_0E.R, v_d);
  } else {
    end = from.T_0E * exp_screw(positional(command.frame), time);
    v_end = positional(command.frame);
  }
  AxisPositions to;
  if (const Objection wrong = place(*rules.robot, end * T_WE.inverse(), from.axes.joints, to)) return wrong;
  if (const Objection wrong = check_range(*rules.robot, from.axes, to, 0)) return wrong;
  if (const Objection wrong = check_workspace(from.T_0E, end, rules.limits)) return wrong;
  if (const Objection wrong = check_first_step(command, v_d, from, T_WE, rules)) return wrong;
  if (const Objection wrong = check_passive_step(command, v_end, rules)) return wrong;
  plan.frame = command.frame;
  plan.v_d = xi_star(from.T_0E.R, v_d);
  return {};
}

}  // namespace

std::optional<Fault> plan_macrostep(const ArmCommand& command, const SetPoint& from, const Pose& T_WE,
                                    const MotionRules& rules, Macrostep& plan) noexcept {
  Macrostep next;
  next.mu = command.mu;
  next.n_s = command.n_s;
  const Objection wrong = command.mu == Interpolation::mim ? plan_mim(command, from, T_WE, rules, next)
                                                           : plan_tcim(command, from, T_WE, rules, next);
  if (!wrong) plan = next;
  return wrong;
}

}  // namespace mrroc::edp
