// The hardware of a simulated robot: the simulator answers over the link.
#pragma once
#include <memory>
#include <string>

#include "base/effector.hpp"
#include "base/link/process.hpp"
#include "base/link/transmission_link.hpp"
#include "base/msg/convert.hpp"
#include "base/msg/convert_platform.hpp"
#include "edp/hardware.hpp"

namespace mrroc::edp {

/// Drives and sensors behind the channels ROBOT.hardware_state and ROBOT.hardware_command. The clock is the simulator's: a
/// step begins when its state comes.
template <Effector E>
class BasicSimulatedHardware {
 public:
  using Drive = typename E::Drive;  ///< set values

  /// Make it before the process assembles.
  /// @param process    must outlive this object
  /// @param simulator  name of the simulator's process
  /// @param dt         duration of a step [s]
  BasicSimulatedHardware(link::Process& process, const std::string& robot, std::string simulator, double dt);

  /// @return ended when the system has finished or the simulator is dead
  /// @throws FaultError in lock-step: hardware_silent or malformed_message, see link::Process::await_from()
  BasicReadResult<E> read(std::int64_t step);
  /// Publishes the command, stamped with its step.
  void write(const Drive& command);

 private:
  using State = link::MessageOf<typename E::Reading>;
  using Command = link::MessageOf<Drive>;

  [[nodiscard]] bool ended() const;
  [[nodiscard]] const State* await_state(std::int64_t step);
  [[nodiscard]] const State* newest_state(std::int64_t step);

  link::Process* process_;
  std::string simulator_;
  link::Process::Clock::duration period_;
  std::unique_ptr<link::Inbox<State>> state_in_;
  std::unique_ptr<link::Outbox<Command>> command_out_;
  link::Sources sources_;
};

/// The hardware of a simulated arm.
using SimulatedHardware = BasicSimulatedHardware<ArmEffector>;
/// The hardware of a simulated platform.
using SimulatedPlatform = BasicSimulatedHardware<PlatformEffector>;

static_assert(Hardware<SimulatedHardware> && Hardware<SimulatedPlatform, PlatformEffector>);

}  // namespace mrroc::edp
