// Shell of an effector driver: joins the driver with the hardware's step and the control subsystem's macrostep.
#pragma once
#include <chrono>
#include <string>

#include "base/link/process.hpp"
#include "edp/driver.hpp"
#include "edp/hardware.hpp"
#include "edp/recorder.hpp"

namespace mrroc::edp {

/// Parameters of a driver's shell in its system.
struct ShellParameters {
  std::string robot;            ///< channels ROBOT.command, .reply, .samples
  std::string ecp;              ///< name of the control subsystem's process
  link::Injection injection{};  ///< faults made on purpose on ROBOT.command
  double dt{0.002};             ///< [s] of a step
  int state_timeout{250};       ///< wall clock: steps without a reading until the drives count as silent
  int axes{};                   ///< of the robot, for its record
  Recording recording{Recording::on_fault};  ///< when the steps are written down
  std::filesystem::path folder{};            ///< where its record goes; empty: nowhere
  std::chrono::milliseconds start_guard{
      250};  ///< commands that come before are left over from an earlier run
};

/// Runs a driver until the control subsystem has released it, the hardware has ended, or the system ends. In lock-step
/// it passes step n_Q when the message for the next macrostep has come (rule R1); it does not wait for a dead control
/// subsystem, and a dead owner's session ends.
///
/// The operator's emergency stop, on the channel `operator`, trips the driver in the next step.
///
/// With the wall clock it never waits for a command: without one the arm comes to rest and holds. After each reading it takes
/// the messages that have come, also when the hardware has a clock of its own. It takes the newest reading; steps that it has
/// missed are counted as skipped, and the number of the macrostep goes on by them, in macrosteps as long as the one in which
/// they were missed, so that the arms of a task stay together. When the hardware is silent for state_timeout steps, the
/// drives brake and the fault hardware_silent is told, which ends the task.
/// @param driver    must be new
/// @param hardware  of the robot
/// @throws FaultError in lock-step: peer_silent or malformed_message when what is waited for does not come, see
///         link::Process::await_from(); what the hardware throws
void run_edp(link::Process& process, Driver& driver, AnyHardware hardware, const ShellParameters& parameters);

}  // namespace mrroc::edp
