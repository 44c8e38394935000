// Shell of a platform's effector driver.
#pragma once
#include "base/link/process.hpp"
#include "edp/hardware.hpp"
#include "edp/platform/driver.hpp"
#include "edp/shell_parameters.hpp"

namespace mrroc::edp {

/// Runs a driver, as run_edp() of an arm does (edp/shell.hpp), until the control subsystem has released it, the hardware has
/// ended, or the system ends. Channels: ROBOT.command, .reply, .telemetry.
///
/// With the wall clock it never waits for a command: without one the platform goes on with what it has been handed, and comes
/// to rest after PlatformDriverParameters::silence macrosteps.
/// @param driver    must be new
/// @param hardware  of the platform
/// @throws FaultError in lock-step: peer_silent or malformed_message when what is waited for does not come, see
///         link::Process::await_from(); what the hardware throws
void run_edp(link::Process& process, PlatformDriver& driver, AnyPlatformHardware hardware,
             const ShellParameters& parameters);

}  // namespace mrroc::edp
