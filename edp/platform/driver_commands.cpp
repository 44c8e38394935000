// EDP_MASTER of a platform: what its driver makes of a command.
#include <tuple>

#include "edp/platform/driver.hpp"
#include "edp/platform/guard.hpp"

namespace mrroc::edp {

void PlatformDriver::take(const PlatformCommand& command) noexcept {
  if (!at_boundary()) return;
  const auto decision = protocol_.admit(command, steps_done_ < p_.start_guard_steps);
  const bool noted = note(command);
  if (decision.admission == Admission::nothing || taken_) return;
  taken_ = true;
  answer_.session = command.session;
  answer_.number = command.number;
  switch (decision.admission) {
    case Admission::nothing:
      break;
    case Admission::replay:
      answer_.replay = true;
      break;
    case Admission::reset:
      answer_.verdict = Verdict::executed;
      reset_pending_ = state_ == DriverState::faulted;
      break;
    case Admission::refuse:
      answer_.verdict = Verdict::refused;
      answer_.fault = decision.fault;
      break;
    case Admission::execute: {
      const std::optional<Fault> wrong = execute(command);
      answer_.verdict = wrong ? Verdict::refused : Verdict::executed;
      if (wrong) answer_.fault = *wrong;
      protocol_.conclude(command, !wrong);
      answer_.store = protocol_.owner().has_value();
      break;
    }
  }
  if (!noted) std::ignore = note(command);  // it may have become the owner's
}

bool PlatformDriver::note(const PlatformCommand& command) noexcept {
  if (!protocol_.owner() || owned_by_another(command.session)) return false;
  heard_ = true;
  observer_.note(command);
  if (command.macrostep < newest_message_) return true;
  newest_message_ = command.macrostep;
  if (is_pace(command.pace))
    wanted_pace_ = command.pace;
  else
    observer_.reject();
  return true;
}

std::optional<Fault> PlatformDriver::execute(const PlatformCommand& command) noexcept {
  if (std::optional<Fault> wrong = check(command)) return wrong;
  if (!protocol_.owner()) begin_session(command);
  if (command.instruction == Instruction::set) start_on(command.fragment);
  if (command.instruction == Instruction::synchro) {
    synchronisation_.start();
    begun_ = false;
    fire(PlatformEvent::synchro);
  }
  return {};
}

void PlatformDriver::begin_session(const PlatformCommand& command) noexcept {
  if (queue_.empty()) queue_.forget_numbers();
  newest_message_ = command.macrostep;
  wanted_pace_ = is_pace(command.pace) ? command.pace : 1;
}

std::int64_t PlatformDriver::next_fragment() const noexcept {
  return !protocol_.owner() && queue_.empty() ? 1 : queue_.accepted() + 1;
}

void PlatformDriver::start_on(const Fragment& fragment) noexcept {
  if (state_ != DriverState::executing) pace_.set(wanted_pace_);
  queue_.push(fragment);
  fire(PlatformEvent::fragment);
}

std::optional<Fault> PlatformDriver::check(const PlatformCommand& command) const noexcept {
  if (std::optional<Fault> wrong = check_instruction(command)) return wrong;
  if (command.instruction == Instruction::synchro) return check_state(PlatformEvent::synchro);
  if (command.instruction != Instruction::set) return {};
  if (std::optional<Fault> wrong = check_state(PlatformEvent::fragment)) return wrong;
  if (fault_) return fault_;  // nobody knows yet why it has been stopped
  if (std::optional<Fault> wrong = check_fragment(command.fragment, *platform_)) return wrong;
  return check_join(command.fragment, next_fragment(), queue_);
}

std::optional<Fault> PlatformDriver::check_state(PlatformEvent event) const noexcept {
  const FaultCode code = transition(state_, event).refusal;
  if (code == FaultCode::none) return {};
  // Nobody has been told yet why the driver is faulted: the cause comes before its consequence.
  if (code == FaultCode::reset_required && !fault_told_) return fault_;
  Fault fault = make_fault(code, to_string(state_));
  if (code == FaultCode::reset_required) {
    fault.axis = fault_.axis;
    fault.text = to_string(fault_.code);
  }
  return fault;
}

}  // namespace mrroc::edp
