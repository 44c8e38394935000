// The hardware of a simulated robot: the simulator answers over the link.
#pragma once
#include <memory>
#include <string>

#include "base/link/process.hpp"
#include "edp/hardware.hpp"
#include "mrroc/hardware_command_t.hpp"
#include "mrroc/hardware_state_t.hpp"

namespace mrroc::edp {

/// Drives and sensors behind the channels ROBOT.hardware_state and ROBOT.hardware_command. The clock is the simulator's: a
/// step begins when its state comes.
class SimulatedHardware {
 public:
  /// Make it before the process assembles.
  /// @param process    must outlive this object
  /// @param simulator  name of the simulator's process
  /// @param dt         duration of a step [s]
  SimulatedHardware(link::Process& process, const std::string& robot, std::string simulator, double dt);

  /// @return ended when the system has finished or the simulator is dead
  /// @throws FaultError in lock-step: hardware_silent or malformed_message, see link::Process::await_from()
  ReadResult read(std::int64_t step);
  /// Publishes the command, stamped with its step.
  void write(const HardwareCommand& command);

 private:
  [[nodiscard]] bool ended() const;
  [[nodiscard]] const hardware_state_t* await_state(std::int64_t step);
  [[nodiscard]] const hardware_state_t* newest_state(std::int64_t step);

  link::Process* process_;
  std::string simulator_;
  link::Process::Clock::duration period_;
  std::unique_ptr<link::Inbox<hardware_state_t>> state_in_;
  std::unique_ptr<link::Outbox<hardware_command_t>> command_out_;
  link::Sources sources_;
};

static_assert(Hardware<SimulatedHardware>);

}  // namespace mrroc::edp
