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

/// @return which parts of the effector a command sets; none for GET and SYNCHRO
std::uint8_t parts_set(const EffectorCommand& c) {
  return c.instruction == Instruction::set || c.instruction == Instruction::set_get ? c.set : std::uint8_t{};
}

}  // namespace

void Driver::take(const EffectorCommand& command) noexcept {
  if (!at_boundary() || taken_) return;
  taken_ = true;
  const Protocol::Decision decision = protocol_.admit(command, steps_done_ < p_.start_guard_steps);
  if (decision.admission == Protocol::Admission::nothing) return;
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
      reset_pending_ = state_ == DriverState::faulted;
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
    if (std::optional<Fault> wrong = generator_.start(command.arm, T_WE)) return wrong;
    arm_commanded_ = true;
    n_ = std::max(command.arm.n_s, command.arm.n_Q);
    n_Q_ = command.arm.n_Q;
  } else if (new_model && model.set_tool) {
    generator_.set_tool(T_WE);
  }
  if (new_model && model.set_force_tool) {
    force_.set_tool(model.weight, Vector3(model.mass_centre[0], model.mass_centre[1], model.mass_centre[2]));
    bias_pending_ = true;
  }
  if (has(parts_set(command), Part::force_bias)) bias_pending_ = true;
  if (command.instruction == Instruction::synchro) synchro_pending_ = true;
  if (command.instruction == Instruction::get || command.instruction == Instruction::set_get) {
    answer_.representation = command.get_representation;
    answer_.feedback = command.feedback;
  }
  return {};
}

std::optional<Fault> Driver::check(const EffectorCommand& command) const noexcept {
  if (std::optional<Fault> wrong = check_form(command)) return wrong;
  const std::uint8_t set = parts_set(command);
  const bool model = has(set, Part::robot_model);
  const std::array<std::pair<Request, bool>, kRequests> requests{{
      {Request::get, command.instruction == Instruction::get || command.instruction == Instruction::set_get},
      {Request::arm, has(set, Part::arm)},
      {Request::tool, model && command.robot_model.set_tool},
      {Request::force_tool, (model && command.robot_model.set_force_tool) || has(set, Part::force_bias)},
      {Request::synchro, command.instruction == Instruction::synchro},
  }};
  for (const auto& [request, wanted] : requests) {
    if (!wanted) continue;
    if (const FaultCode code = verdict_on(state_, request); code != FaultCode::none) {
      Fault fault = make_fault(code, to_string(state_));
      if (code == FaultCode::reset_required) {
        fault.axis = fault_.axis;
        fault.text = to_string(fault_.code);
      }
      return fault;
    }
  }
  if (has(set, Part::arm)) {
    if (fault_) return fault_;  // the arm is still on its way to rest, or nobody knows yet why
    if (std::optional<Fault> wrong = check_arm(command.arm, robot_->axes(), p_.limits)) return wrong;
  }
  if (model) return check_model(command.robot_model, p_.limits);
  return {};
}

}  // namespace mrroc::edp
