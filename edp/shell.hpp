// Shell of an arm's effector driver: joins the driver with the hardware's step and the control subsystem's macrostep. That of
// other kinds is the same (edp/shell_impl.hpp).
#pragma once
#include "base/link/process.hpp"
#include "edp/driver.hpp"
#include "edp/hardware.hpp"
#include "edp/shell_parameters.hpp"

namespace mrroc::edp {

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
