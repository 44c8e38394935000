#include "edp/step_generator.hpp"

#include "edp/control_law.hpp"
#include "edp/deceleration.hpp"

namespace mrroc::edp {

StepGenerator::StepGenerator(const MotionRules& rules, const Pose& T_WE) noexcept
    : rules_(rules),
      ranges_(*rules.robot, rules.dt, rules.limits.motor_acceleration),
      T_WE_(T_WE),
      T_EW_(T_WE.inverse()),
      R_0W_(Matrix3::Identity()) {
  stand_at(AxisVector::Zero(rules.robot->axes()));
}

void StepGenerator::stand_at(const AxisVector& motors) noexcept {
  Candidate here;
  place(motors, here);
  set_.T_0E = here.T_0E;
  set_.axes = here.axes;
  R_0W_ = here.R_0W;
  stand();
}

void StepGenerator::set_robot(const Robot& robot) noexcept {
  rules_.robot = &robot;
  ranges_ = AxisRanges(robot, rules_.dt, rules_.limits.motor_acceleration);
  stand_at(AxisVector(set_.axes.motors));
}

void StepGenerator::shift(const AxisVector& increment) noexcept {
  motion_ = Motion::executing;
  macrostep_.mu = Interpolation::mim;
  set_.motor_increment = increment;
  set_.axes.motors += increment;
}

void StepGenerator::stand() noexcept {
  motion_ = Motion::standing;
  set_.motor_increment = AxisVector::Zero(rules_.robot->axes());
  set_.v_0W = {};
}

std::optional<Fault> StepGenerator::start(const ArmCommand& command, const Pose& T_WE) noexcept {
  SetPoint from = set_;
  from.T_0E = set_.T_0E * T_EW_ * T_WE;
  if (const std::optional<Fault> wrong = plan_macrostep(command, from, T_WE, rules_, macrostep_))
    return wrong;
  set_tool(T_WE);
  motion_ = Motion::executing;
  k_ = 0;
  return {};
}

void StepGenerator::set_tool(const Pose& T_WE) noexcept {
  set_.T_0E = set_.T_0E * T_EW_ * T_WE;
  T_WE_ = T_WE;
  T_EW_ = T_WE.inverse();
}

void StepGenerator::stop() noexcept {
  if (motion_ != Motion::executing) return;
  if ((set_.motor_increment.array() == 0).all()) return stand();
  motion_ = Motion::stopping;
  stop_in_motors_ = macrostep_.mu == Interpolation::mim;
  stop_at_once_ = false;
  k_ = 0;
}

std::optional<Fault> StepGenerator::step(const Wrench& F_a) noexcept {
  if (motion_ == Motion::standing) return {};
  if (motion_ == Motion::stopping) {
    stop_step();
    return {};
  }
  std::optional<Fault> wrong = k_ == macrostep_.n_s ? passive_step() : active_step(F_a);
  if (!wrong) return wrong;
  // The motors can be brought to rest wherever the arm is, which does not hold for the task frame: it may be
  // the inverse kinematics that has no solution.
  motion_ = Motion::stopping;
  stop_in_motors_ = true;
  stop_at_once_ = wrong->code == FaultCode::force_limit;  // every farther step would press harder
  k_ = 0;
  stop_step();
  return wrong;
}

std::optional<Fault> StepGenerator::active_step(const Wrench& F_a) noexcept {
  ++k_;
  Candidate next;
  if (std::optional<Fault> wrong = execute(F_a, next)) return wrong;
  if (std::optional<Fault> wrong = check(next)) return wrong;
  if (std::optional<Fault> wrong = check_stop(next, stopping_way(rules_.stop_steps))) return wrong;
  accept(next);
  return {};
}

std::optional<Fault> StepGenerator::passive_step() noexcept {
  const AxisVector rest = AxisVector::Zero(rules_.robot->axes());
  const bool in_task_frame = macrostep_.mu != Interpolation::mim;
  if (in_task_frame)
    if (std::optional<Fault> wrong =
            check_acceleration(velocity_of_E(set_, T_EW_), {}, rules_.dt, rules_.limits))
      return wrong;
  if (std::optional<Fault> wrong =
          check_motor_acceleration(set_.motor_increment / rules_.dt, rest, rules_.dt, rules_.limits))
    return wrong;
  set_.motor_increment = rest;
  if (!in_task_frame) set_.v_0W = {};  // the law keeps its memory over the step
  return {};
}

std::optional<Fault> StepGenerator::execute(const Wrench& F_a, Candidate& next) noexcept {
  const double dt = rules_.dt;
  if (macrostep_.mu == Interpolation::mim) {
    const double part = static_cast<double>(k_) / macrostep_.n_s;
    place(macrostep_.from + part * (macrostep_.to - macrostep_.from), next);
    if (!rules_.position_known) return {};
    const Twist v_E = xi_V(T_EW_, xi_star(R_0W_.transpose(), next.v_0W));
    if (std::optional<Fault> wrong = check_velocity(v_E, rules_.limits)) return wrong;
    return check_contact_force(F_a, v_E, rules_.limits);
  }
  if (macrostep_.mu == Interpolation::tcim_pose) {
    const Twist v_d = xi_star(set_.T_0E.R.transpose(), macrostep_.v_d);
    for (const Axis a : kAxes) macrostep_.frame[a].velocity = v_d[a];
  }
  const Twist v_before = previous_velocity();
  const Twist v_c = step_velocity(macrostep_.frame, F_a, v_before, dt);
  if (std::optional<Fault> wrong = check_velocity(v_c, rules_.limits)) return wrong;
  if (std::optional<Fault> wrong = check_contact_force(F_a, v_c, rules_.limits)) return wrong;
  const bool stood = set_.motor_increment.isZero(0);
  if (std::optional<Fault> wrong = check_acceleration(stood ? Twist{} : v_before, v_c, dt, rules_.limits))
    return wrong;
  return follow(v_c, next);
}

Twist StepGenerator::previous_velocity() const noexcept {
  return xi_V(T_EW_, xi_star(R_0W_.transpose(), set_.v_0W));
}

std::optional<Fault> StepGenerator::follow(const Twist& v_E, Candidate& next) const noexcept {
  next.T_0E = set_.T_0E * pose_from_angle_axis(v_E.vector() * rules_.dt);  // eq. (29), (30)
  next.T_0E.R = orthonormal(next.T_0E.R);
  next.v_0W = xi_star(R_0W_, xi_V(T_WE_, v_E));
  const Pose T_0W = next.T_0E * T_EW_;
  next.R_0W = T_0W.R;
  const InverseSolution s = rules_.robot->inverse(T_0W, set_.axes.joints);
  if (!s.reached) return make_fault(FaultCode::unreachable_pose, "missing [m]", -1, s.missing);
  next.axes.joints = s.joints;
  next.axes.motors = rules_.robot->motors_from_joints(s.joints);
  return {};
}

void StepGenerator::place(const AxisVector& motors, Candidate& next) const noexcept {
  next.axes.motors = motors;
  if (!rules_.position_known) {
    next.axes.joints = set_.axes.joints;
    next.T_0E = set_.T_0E;
    next.R_0W = R_0W_;
    return;
  }
  next.axes.joints = rules_.robot->joints_from_motors(motors);
  const Pose T_0W = rules_.robot->forward(next.axes.joints);
  next.T_0E = T_0W * T_WE_;
  next.R_0W = T_0W.R;
  const Vector6 r = angle_axis_from_pose(set_.T_0E.inverse() * next.T_0E) / rules_.dt;
  const Twist v_E = Twist::from(r.head<3>(), r.tail<3>());
  next.v_0W = xi_star(R_0W_, xi_V(T_WE_, v_E));
}

std::optional<Fault> StepGenerator::check(const Candidate& next) const noexcept {
  const Robot& robot = *rules_.robot;
  const bool in_ranges = !rules_.position_known || ranges_.contain(next.axes);
  if (in_ranges && ranges_.allow(set_.motor_increment, next.axes.motors - set_.axes.motors)) return {};
  if (rules_.position_known)
    if (std::optional<Fault> wrong = check_range(robot, set_.axes, next.axes, 0)) return wrong;
  if (std::optional<Fault> wrong = check_motor_speed(robot, set_.axes.motors, next.axes.motors, rules_.dt))
    return wrong;
  return check_motor_acceleration(set_.motor_increment / rules_.dt,
                                  (next.axes.motors - set_.axes.motors) / rules_.dt, rules_.dt,
                                  rules_.limits);
}

std::optional<Fault> StepGenerator::check_stop(const Candidate& next, double way) const noexcept {
  if (!rules_.position_known) return {};
  const Robot& robot = *rules_.robot;
  AxisPositions end;
  end.motors = next.axes.motors + way * (next.axes.motors - set_.axes.motors);
  end.joints = robot.joints_from_motors(end.motors);
  if (!ranges_.contain(end))
    if (std::optional<Fault> wrong = check_range(robot, set_.axes, end, 0)) return wrong;
  if (!rules_.limits.workspace) return {};
  return check_workspace(set_.T_0E, robot.forward(end.joints) * T_WE_, rules_.limits);
}

void StepGenerator::accept(const Candidate& next) noexcept {
  set_.motor_increment = next.axes.motors - set_.axes.motors;
  set_.axes = next.axes;
  set_.T_0E = next.T_0E;
  R_0W_ = next.R_0W;
  set_.v_0W = next.v_0W;
}

void StepGenerator::stop_step() noexcept {
  if (stop_at_once_) return brake();
  ++k_;
  if (k_ >= rules_.stop_steps) return stand();
  const double ratio = speed_ratio(k_, rules_.stop_steps);
  Candidate next;
  if (!stop_in_motors_) {
    // The motors must be able to take over the rest of the stop wherever the task frame ends.
    const double rest = remaining_way(k_, rules_.stop_steps);
    if (!follow(ratio * previous_velocity(), next) && !check(next) && !check_stop(next, rest))
      return accept(next);
    stop_in_motors_ = true;
  }
  place(set_.axes.motors + ratio * set_.motor_increment, next);
  if (check(next)) return brake();
  accept(next);
}

void StepGenerator::brake() noexcept {
  // Joints that are differences of others may bend on the way although the end is legal.
  const double most = rules_.limits.motor_acceleration * rules_.dt * rules_.dt;
  const AxisVector slower =
      set_.motor_increment - AxisVector(set_.motor_increment.cwiseMax(-most).cwiseMin(most));
  if (slower.isZero(0)) return stand();
  Candidate next;
  place(set_.axes.motors + slower, next);
  accept(next);
}

}  // namespace mrroc::edp
