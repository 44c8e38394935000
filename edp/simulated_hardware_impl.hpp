// Bodies of edp/simulated_hardware.hpp, for the files that instantiate them.
#pragma once
#include <chrono>
#include <utility>

#include "edp/simulated_hardware.hpp"

namespace mrroc::edp {

template <Effector E>
BasicSimulatedHardware<E>::BasicSimulatedHardware(link::Process& process, const std::string& robot,
                                                  std::string simulator, double dt)
    : process_(&process),
      simulator_(std::move(simulator)),
      period_(std::chrono::duration_cast<link::Process::Clock::duration>(std::chrono::duration<double>(dt))),
      state_in_(process.inbox<State>(robot + ".hardware_state", link::Group::servo_state)),
      command_out_(process.outbox<Command>(robot + ".hardware_command", link::Group::servo_command)),
      sources_{state_in_.get()} {}

template <Effector E>
bool BasicSimulatedHardware<E>::ended() const {
  return process_->phase() == link::Phase::finished || process_->dead(simulator_);
}

template <Effector E>
BasicReadResult<E> BasicSimulatedHardware<E>::read(std::int64_t step) {
  const State* const state = process_->lock_step() ? await_state(step) : newest_state(step);
  BasicReadResult<E> result{ended() ? ReadStatus::ended : ReadStatus::silent};
  if (!state) return result;
  result.status = ReadStatus::reading;
  result.reading = from_message(*state);
  if (state->begun > 0) result.begun = state->begun;
  return result;
}

template <Effector E>
auto BasicSimulatedHardware<E>::await_state(std::int64_t step) -> const State* {
  process_->await_from(sources_, FaultCode::hardware_silent, [&] { return state_in_->at(step) || ended(); });
  return state_in_->at(step);
}

template <Effector E>
auto BasicSimulatedHardware<E>::newest_state(std::int64_t step) -> const State* {
  if (ended()) return nullptr;
  const auto newest = [&]() -> const State* {
    const State* const state = state_in_->newest();
    return state && state->header.stamp >= step ? state : nullptr;
  };
  process_->await([&] { return newest() || process_->phase() == link::Phase::finished; },
                  link::Process::Clock::now() + period_);
  process_->poll();
  return newest();
}

template <Effector E>
void BasicSimulatedHardware<E>::write(const Drive& command) {
  command_out_->publish(to_message(command), command.step);
}

}  // namespace mrroc::edp
