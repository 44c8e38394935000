#include "edp/step_generator.hpp"

#include <algorithm>

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
  phase_ = MotionPhase::executing;
  macrostep_ = {};
  macrostep_.mu = Interpolation::mim;
  set_.motor_increment = increment;
  set_.axes.motors += increment;
}

void StepGenerator::stand() noexcept {
  phase_ = MotionPhase::standing;
  at_goal_ = false;
  passive_ = false;
  goal_.reset();
  set_.motor_increment = AxisVector::Zero(rules_.robot->axes());
  set_.v_0W = {};
}

Beginning StepGenerator::beginning(const Pose& T_WE) const noexcept {
  Beginning begin;
  begin.from = set_;
  begin.from.T_0E = begin.T_0E = set_.T_0E * T_EW_ * T_WE;
  begin.axes = set_.axes;
  begin.at_rest = set_.motor_increment.isZero(0) && !passive_;
  if (!goal_) return begin;
  begin.on_the_way = true;
  begin.T_0E = goal_->T_0W * T_WE;
  begin.axes = goal_->axes;
  return begin;
}

std::optional<Fault> StepGenerator::start(const ArmCommand& command, const Pose& T_WE) noexcept {
  if (const std::optional<Fault> wrong = plan_macrostep(command, beginning(T_WE), T_WE, rules_, macrostep_))
    return wrong;
  change_tool(T_WE);
  phase_ = MotionPhase::executing;
  at_goal_ = false;
  returning_ = false;
  goal_.reset();
  if (macrostep_.approach) goal_ = macrostep_.goal;
  k_ = 0;
  return {};
}

void StepGenerator::set_tool(const Pose& T_WE) noexcept {
  change_tool(T_WE);
  // An approach in the task frame moves the E that it was planned for. The motors can go on to where the wrist belongs.
  if (!macrostep_.approach || macrostep_.mu == Interpolation::mim) return;
  macrostep_.approach.reset();
  if (phase_ == MotionPhase::arriving) begin_stop(rules_.stop_steps);
}

void StepGenerator::change_tool(const Pose& T_WE) noexcept {
  set_.T_0E = set_.T_0E * T_EW_ * T_WE;
  T_WE_ = T_WE;
  T_EW_ = T_WE.inverse();
}

void StepGenerator::finish() noexcept {
  if (phase_ != MotionPhase::executing) return;
  if (!macrostep_.goal) return stop();
  goal_ = macrostep_.goal;
  if (macrostep_.approach) {
    phase_ = MotionPhase::arriving;
    return;
  }
  begin_stop(macrostep_.stop_steps);
}

void StepGenerator::stop() noexcept {
  goal_.reset();
  if (phase_ != MotionPhase::executing && phase_ != MotionPhase::arriving) return;
  if (!nearly_there()) return begin_stop(rules_.stop_steps);
  phase_ = MotionPhase::arriving;
}

// A stop would lead beyond the goal, which may lie at a limit. In the task frame the law would go on, and it may be what has
// to stop.
bool StepGenerator::nearly_there() const noexcept {
  const bool returns = phase_ == MotionPhase::arriving && returning_;
  return macrostep_.mu == Interpolation::mim && macrostep_.approach && !returns &&
         !set_.motor_increment.isZero(0) &&
         macrostep_.approach->remaining(k_) < stopping_way(rules_.stop_steps);
}

void StepGenerator::begin_stop(int steps) noexcept {
  if ((set_.motor_increment.array() == 0).all()) return end_stop();
  phase_ = MotionPhase::stopping;
  stop_steps_ = steps;
  stop_in_motors_ = macrostep_.mu == Interpolation::mim;
  stop_at_once_ = false;
  k_ = 0;
}

void StepGenerator::end_stop() noexcept {
  const std::optional<Goal> goal = goal_;
  stand();
  if (!goal) return;
  to_ = goal->axes.motors;
  if (macrostep_.mu != Interpolation::mim) {
    const InverseSolution s = rules_.robot->inverse(goal->T_0W, set_.axes.joints);
    if (!s.reached) return;
    to_ = rules_.robot->motors_from_joints(s.joints);
  }
  at_goal_ = true;
  constexpr double kThere = 1e-6;  // [rad], a 600th of an increment
  from_ = set_.axes.motors;
  if ((to_ - from_).cwiseAbs().maxCoeff() <= kThere) return;
  phase_ = MotionPhase::arriving;
  at_goal_ = false;
  returning_ = true;
  goal_ = goal;
  k_ = 0;
}

std::optional<Fault> StepGenerator::step(const Wrench& F_a) noexcept {
  if (phase_ == MotionPhase::standing) return {};
  if (phase_ == MotionPhase::stopping) {
    stop_step();
    return {};
  }
  passive_ = phase_ == MotionPhase::executing && k_ == macrostep_.n_s && !macrostep_.approach;
  std::optional<Fault> wrong = phase_ == MotionPhase::arriving ? arriving_step(F_a)
                               : passive_                      ? passive_step()
                                                               : active_step(F_a);
  if (!wrong) return wrong;
  // The motors can be brought to rest wherever the arm is, which does not hold for the task frame: it may be
  // the inverse kinematics that has no solution.
  goal_.reset();
  phase_ = MotionPhase::stopping;
  stop_steps_ = rules_.stop_steps;
  stop_in_motors_ = true;
  stop_at_once_ = wrong->code == FaultCode::force_limit;  // every farther step would press harder
  k_ = 0;
  stop_step();
  return wrong;
}

std::optional<Fault> StepGenerator::arriving_step(const Wrench& F_a) noexcept {
  const int steps = returning_ ? return_steps(stop_steps_) : macrostep_.approach->steps();
  if (k_ < steps) return returning_ ? returning_step(F_a) : active_step(F_a);
  const bool has_goal = goal_.has_value();
  stand();
  at_goal_ = has_goal;
  return {};
}

std::optional<Fault> StepGenerator::returning_step(const Wrench& F_a) noexcept {
  ++k_;
  Candidate next;
  place(from_ + minimum_jerk(k_, return_steps(stop_steps_)) * (to_ - from_), next);
  if (std::optional<Fault> wrong = check_motion(next, F_a)) return wrong;
  if (std::optional<Fault> wrong = check(next)) return wrong;
  accept(next);
  return {};
}

std::optional<Fault> StepGenerator::active_step(const Wrench& F_a) noexcept {
  ++k_;
  Candidate next;
  if (std::optional<Fault> wrong = execute(F_a, next)) return wrong;
  if (std::optional<Fault> wrong = check(next)) return wrong;
  double way = stopping_way(rules_.stop_steps);
  if (macrostep_.approach) way = std::min(way, macrostep_.approach->remaining(k_));
  if (std::optional<Fault> wrong = check_stop(next, way)) return wrong;
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
    const double part =
        macrostep_.approach ? macrostep_.approach->part(k_) : static_cast<double>(k_) / macrostep_.n_s;
    place(macrostep_.from + part * (macrostep_.to - macrostep_.from), next);
    return check_motion(next, F_a);
  }
  if (macrostep_.mu == Interpolation::tcim_pose) {
    Twist v_d = xi_star(set_.T_0E.R.transpose(), macrostep_.v_d);
    if (macrostep_.approach) v_d = macrostep_.approach->speed(k_) * v_d;
    for (const Axis a : kAxes) macrostep_.frame[a].velocity = v_d[a];
  }
  const Twist v_before = previous_velocity();
  const Twist v_c = step_velocity(softened(macrostep_.frame, shares_), F_a, v_before, dt);
  if (std::optional<Fault> wrong = check_velocity(v_c, rules_.limits)) return wrong;
  if (std::optional<Fault> wrong = check_contact_force(F_a, v_c, rules_.limits)) return wrong;
  const bool stood = set_.motor_increment.isZero(0);
  if (std::optional<Fault> wrong = check_acceleration(stood ? Twist{} : v_before, v_c, dt, rules_.limits))
    return wrong;
  return follow(v_c, next);
}

std::optional<Fault> StepGenerator::check_motion(const Candidate& next, const Wrench& F_a) const noexcept {
  if (!rules_.position_known) return {};
  const Twist v_E = xi_V(T_EW_, xi_star(R_0W_.transpose(), next.v_0W));
  if (std::optional<Fault> wrong = check_velocity(v_E, rules_.limits)) return wrong;
  return check_contact_force(F_a, v_E, rules_.limits);
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
  if (k_ >= stop_steps_) return end_stop();
  const double ratio = speed_ratio(k_, stop_steps_);
  Candidate next;
  if (!stop_in_motors_) {
    // The motors must be able to take over the rest of the stop wherever the task frame ends.
    const double rest = remaining_way(k_, stop_steps_);
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
  if (slower.isZero(0)) return end_stop();
  Candidate next;
  place(set_.axes.motors + slower, next);
  accept(next);
}

}  // namespace mrroc::edp
