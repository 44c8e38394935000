#include "edp/simulated_hardware.hpp"

#include "base/msg/convert.hpp"

namespace mrroc::edp {

using link::Group;
using link::Phase;
using link::Process;

SimulatedHardware::SimulatedHardware(Process& process, const std::string& robot, std::string simulator,
                                     double dt)
    : process_(&process),
      simulator_(std::move(simulator)),
      period_(std::chrono::duration_cast<Process::Clock::duration>(std::chrono::duration<double>(dt))),
      state_in_(process.inbox<hardware_state_t>(robot + ".hardware_state", Group::servo_state)),
      command_out_(process.outbox<hardware_command_t>(robot + ".hardware_command", Group::servo_command)),
      sources_{state_in_.get()} {}

bool SimulatedHardware::ended() const {
  return process_->phase() == Phase::finished || process_->dead(simulator_);
}

ReadResult SimulatedHardware::read(std::int64_t step) {
  const hardware_state_t* const state = process_->lock_step() ? await_state(step) : newest_state(step);
  ReadResult result{ended() ? ReadStatus::ended : ReadStatus::silent};
  if (!state) return result;
  result.status = ReadStatus::reading;
  result.reading = from_message(*state);
  if (state->begun > 0) result.begun = state->begun;
  return result;
}

const hardware_state_t* SimulatedHardware::await_state(std::int64_t step) {
  process_->await_from(sources_, FaultCode::hardware_silent, [&] { return state_in_->at(step) || ended(); });
  return state_in_->at(step);
}

const hardware_state_t* SimulatedHardware::newest_state(std::int64_t step) {
  if (ended()) return nullptr;
  const auto newest = [&]() -> const hardware_state_t* {
    const hardware_state_t* const state = state_in_->newest();
    return state && state->header.stamp >= step ? state : nullptr;
  };
  process_->await([&] { return newest() || process_->phase() == Phase::finished; },
                  Process::Clock::now() + period_);
  process_->poll();
  return newest();
}

void SimulatedHardware::write(const HardwareCommand& command) {
  command_out_->publish(to_message(command), command.step);
}

}  // namespace mrroc::edp
