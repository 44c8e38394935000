// EDP_MASTER: what a Driver makes of a command.
#include <algorithm>
#include <array>
#include <utility>

#include "base/representation.hpp"
#include "edp/automaton.hpp"
#include "edp/driver.hpp"
#include "edp/guard.hpp"

namespace mrroc::edp {
namespace {

bool is_motion(const EffectorCommand& c) {
  return (c.instruction == Instruction::set || c.instruction == Instruction::set_get) &&
         has(c.set, Part::arm);
}

/// @return whether the motion needs no synchronisation
bool is_jog(const EffectorCommand& c) {
  return c.arm.mu == Interpolation::mim && c.arm.representation == Representation::motors &&
         c.arm.reference == Reference::relative;
}

/// @return which parts of the effector a command sets; none for GET and SYNCHRO
std::uint8_t parts_set(const EffectorCommand& c) {
  return c.instruction == Instruction::set || c.instruction == Instruction::set_get ? c.set : std::uint8_t{};
}

}  // namespace

void Driver::take(const EffectorCommand& command) noexcept {
  if (!at_boundary()) return;
  const Protocol::Decision decision = protocol_.admit(command, steps_done_ < p_.start_guard_steps);
  if (decision.admission == Protocol::Admission::nothing || taken_) return;
  taken_ = true;
  answer_.session = command.session;
  answer_.number = command.number;
  switch (decision.admission) {
    case Protocol::Admission::nothing:
      break;
    case Protocol::Admission::replay:
      answer_.replay = true;
      break;
    case Protocol::Admission::reset:
      answer_.verdict = Verdict::executed;
      reset_pending_ =
          transition(state_, position_known_ ? Event::reset : Event::reset_unknown).next != state_;
      break;
    case Protocol::Admission::refuse:
      answer_.verdict = Verdict::refused;
      answer_.fault = decision.fault;
      break;
    case Protocol::Admission::execute: {
      const std::optional<Fault> wrong = execute(command);
      answer_.verdict = wrong ? Verdict::refused : Verdict::executed;
      if (wrong) answer_.fault = *wrong;
      protocol_.conclude(command, !wrong);
      answer_.store = protocol_.owner().has_value();
      break;
    }
  }
}

std::optional<Fault> Driver::execute(const EffectorCommand& command) noexcept {
  if (std::optional<Fault> wrong = check(command)) return wrong;
  const RobotModel& model = command.robot_model;
  const bool new_model = has(parts_set(command), Part::robot_model);
  Pose T_WE = generator_.tool();
  if (new_model && model.set_tool)
    T_WE = pose_from_numbers(model.tool_representation, model.tool).value_or(T_WE);
  // From here on only the start of the motion can still be refused; it comes first.
  if (is_motion(command)) {
    if (std::optional<Fault> wrong = start_motion(command, T_WE)) return wrong;
  } else if (new_model) {
    if (model.set_tool) generator_.set_tool(T_WE);
    if (model.set_kinematic_model) generator_.set_robot(*robot_->with_model(model.kinematic_model));
  }
  if (new_model) set_model(model);
  if (has(parts_set(command), Part::force_bias)) bias_pending_ = true;
  if (has(parts_set(command), Part::io)) outputs_ = command.outputs;
  if (command.instruction == Instruction::synchro) start_homing();
  if (command.instruction == Instruction::get || command.instruction == Instruction::set_get) {
    answer_.parts = command.get;
    answer_.representation = command.get_representation;
    answer_.tool_representation = command.get_tool_representation;
    answer_.feedback = command.feedback;
  }
  return {};
}

std::optional<Fault> Driver::start_motion(const EffectorCommand& command, const Pose& T_WE) noexcept {
  const RobotModel& model = command.robot_model;
  const bool other_robot = has(command.set, Part::robot_model) && model.set_kinematic_model;
  const bool from_brakes = !position_known_ && braked();
  if (other_robot || from_brakes) {
    StepGenerator before = generator_;
    if (other_robot) generator_.set_robot(*robot_->with_model(model.kinematic_model));
    if (from_brakes) generator_.stand_at(measured_.motors);
    if (std::optional<Fault> wrong = generator_.start(command.arm, T_WE)) {
      generator_ = before;
      return wrong;
    }
    if (from_brakes) servo_.reset();
  } else if (std::optional<Fault> wrong = generator_.start(command.arm, T_WE)) {
    return wrong;
  }
  n_ = std::max(command.arm.n_s, command.arm.n_Q);
  n_Q_ = command.arm.n_Q;
  if (gripper_ && gripper_->known() && command.arm.gripper != 0) gripper_->set_distance(command.arm.gripper);
  rows_ = command.arm.frame;
  force_axes_ = command.arm.mu == Interpolation::mim ? AxisSet() : force_axes(rows_);
  motion_event_ = is_jog(command) ? Event::jog : Event::arm;
  return {};
}

void Driver::set_model(const RobotModel& model) noexcept {
  if (model.set_kinematic_model) {
    robot_ = robot_->with_model(model.kinematic_model);
    model_.kinematic_model = model.kinematic_model;
  }
  for (int k = 0; k < robot_->axes(); ++k)
    if (const auto motor = static_cast<std::size_t>(k); (model.set_servo_algorithm >> k & 1) != 0)
      servo_.select(k, model.servo_algorithm[motor], model.servo_parameter_set[motor]);
  if (model.set_force_tool) {
    force_.set_tool(model.weight, Vector3(model.mass_centre[0], model.mass_centre[1], model.mass_centre[2]));
    model_.weight = model.weight;
    model_.mass_centre = model.mass_centre;
    bias_pending_ = true;
  }
}

void Driver::start_homing() noexcept {
  if (braked()) stand_where_measured();
  homing_.start();
  fire(Event::synchro);
}

std::optional<Fault> Driver::check(const EffectorCommand& command) const noexcept {
  if (std::optional<Fault> wrong = check_form(command)) return wrong;
  if (std::optional<Fault> wrong = check_state(command)) return wrong;
  const std::uint8_t set = parts_set(command);
  if (has(set, Part::arm)) {
    if (fault_) return fault_;  // the arm is still on its way to rest, or nobody knows yet why
    if (std::optional<Fault> wrong = check_arm(command.arm, robot_->axes(), p_.limits)) return wrong;
    if (std::optional<Fault> wrong = check_jaws(command.arm.gripper)) return wrong;
  }
  if (has(set, Part::robot_model)) return check_model(command.robot_model, *robot_, p_.limits);
  return {};
}

std::optional<Fault> Driver::check_jaws(double distance) const noexcept {
  if (!gripper_ || distance == 0) return {};
  if (!gripper_->known()) return make_fault(FaultCode::not_synchronised, "distance of the jaws");
  return check_distance(gripper_->parameters(), distance);
}

std::optional<Fault> Driver::check_state(const EffectorCommand& command) const noexcept {
  const std::uint8_t set = parts_set(command);
  const bool model = has(set, Part::robot_model);
  const RobotModel& m = command.robot_model;
  const bool gets = command.instruction == Instruction::get || command.instruction == Instruction::set_get;
  const std::array<std::pair<Event, bool>, 9> asked{{
      {Event::get, gets},
      {Event::arm, has(set, Part::arm) && !is_jog(command)},
      {Event::jog, has(set, Part::arm) && is_jog(command)},
      {Event::tool, model && m.set_tool},
      {Event::kinematic_model, model && m.set_kinematic_model},
      {Event::servo_algorithm, model && m.set_servo_algorithm != 0},
      {Event::force_tool, (model && m.set_force_tool) || has(set, Part::force_bias)},
      {Event::outputs, has(set, Part::io)},
      {Event::synchro, command.instruction == Instruction::synchro},
  }};
  for (const auto& [event, wanted] : asked) {
    const FaultCode code = transition(state_, event).refusal;
    if (!wanted || code == FaultCode::none) continue;
    // Nobody has been told yet why the driver is faulted: the cause comes before its consequence.
    if (code == FaultCode::reset_required && !fault_told_) return fault_;
    Fault fault = make_fault(code, to_string(state_));
    if (code == FaultCode::reset_required) {
      fault.axis = fault_.axis;
      fault.text = to_string(fault_.code);
    }
    return fault;
  }
  return {};
}

}  // namespace mrroc::edp
