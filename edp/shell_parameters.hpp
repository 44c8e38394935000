// Parameters of an effector driver's shell.
#pragma once
#include <chrono>
#include <filesystem>
#include <string>

#include "base/link/injection.hpp"
#include "edp/recorder.hpp"

namespace mrroc::edp {

/// Parameters of a driver's shell in its system.
struct ShellParameters {
  std::string robot;  ///< channels ROBOT.command, .reply; of an arm .samples, of a platform .telemetry
  std::string ecp;    ///< name of the control subsystem's process
  link::Injection injection{};  ///< faults made on purpose on ROBOT.command
  double dt{0.002};             ///< [s] of a step
  int state_timeout{250};       ///< wall clock: steps without a reading until the drives count as silent
  int axes{};                   ///< of an arm, for its record
  Recording recording{Recording::on_fault};  ///< when the steps are written down
  std::filesystem::path folder{};            ///< where its record goes; empty: nowhere
  std::chrono::milliseconds start_guard{
      250};  ///< commands that come before are left over from an earlier run
};

}  // namespace mrroc::edp
