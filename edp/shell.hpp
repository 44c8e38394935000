// Shell of an effector driver: joins the driver with the world's step and the control subsystem's macrostep.
#pragma once
#include <chrono>
#include <string>

#include "base/link/process.hpp"
#include "edp/driver.hpp"

namespace mrroc::edp {

/// How a driver belongs to its system.
struct ShellParameters {
  std::string robot;            ///< channels ROBOT.command, .reply, .samples, .drive
  int index{};                  ///< of the robot in world_state_t
  std::string ecp;              ///< name of the control subsystem's process
  std::string world{"world"};   ///< name of the world's process
  link::Injection injection{};  ///< faults made on purpose on ROBOT.command
  std::chrono::milliseconds start_guard{
      250};  ///< commands that come before are left over from an earlier run
};

/// Runs a driver until the control subsystem has released it or the system ends. In lock-step it passes step
/// n_Q when the message for the next macrostep has come (rule R1); with the wall clock it never waits for a
/// command.
/// @param driver  must be new
void run_edp(link::Process& process, Driver& driver, const ShellParameters& parameters);

}  // namespace mrroc::edp
