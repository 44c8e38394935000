// Shell of an effector driver: joins the driver with the world's step and the control subsystem's macrostep.
#pragma once
#include <chrono>
#include <string>

#include "base/link/process.hpp"
#include "edp/driver.hpp"
#include "edp/recorder.hpp"

namespace mrroc::edp {

/// How a driver belongs to its system.
struct ShellParameters {
  std::string robot;            ///< channels ROBOT.command, .reply, .samples, .drive
  int index{};                  ///< of the robot in world_state_t
  std::string ecp;              ///< name of the control subsystem's process
  std::string world{"world"};   ///< name of the world's process
  link::Injection injection{};  ///< faults made on purpose on ROBOT.command
  int n_s{10};                  ///< steps of a macrostep without a command
  double dt{0.002};             ///< [s] of a step
  int state_patience{250};      ///< wall clock: steps without a state until the drives count as silent
  int axes{};                   ///< of the robot, for its record
  Recording recording{Recording::on_fault};  ///< when the steps are written down
  std::filesystem::path folder{};            ///< where its record goes; empty: nowhere
  std::chrono::milliseconds start_guard{
      250};  ///< commands that come before are left over from an earlier run
};

/// Runs a driver until the control subsystem has released it or the system ends. In lock-step it passes step
/// n_Q when the message for the next macrostep has come (rule R1); it waits for neither a dead control
/// subsystem nor a dead world, and a dead owner's session ends.
///
/// The operator's emergency stop, on the channel `operator`, trips the driver in the next step.
///
/// With the wall clock it never waits for a command: without one the arm comes to rest and holds. It takes the
/// newest state; states that it has missed are counted as skipped steps, and the number of the macrostep goes on
/// by them, so that the arms of a task stay together. When the world is silent for state_patience steps, the
/// drives brake and the fault hardware_silent is told, which ends the task.
/// @param driver  must be new
/// @throws FaultError in lock-step: hardware_silent, peer_silent or malformed_message when what is waited for
///         does not come, see link::Process::await_from()
void run_edp(link::Process& process, Driver& driver, const ShellParameters& parameters);

}  // namespace mrroc::edp
