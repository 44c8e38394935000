// Which processes of a task run on which host.
//
//   [hosts.robot]
//   processes = ["world", "edp-arm1"]
//   start = ["ssh", "robot"]      # words before the program: they make it run over there
//
// Programs and the run folder must be there under the same paths (a shared folder does it). Clocks need not agree: time is
// counted in steps.
#pragma once
#include <string>
#include <vector>

#include "base/config.hpp"
#include "mp/supervisor.hpp"

namespace mrroc::mp {

/// Another host.
struct Host {
  std::string name;                    ///< of its table
  std::vector<std::string> processes;  ///< that run there
  std::vector<std::string> start;      ///< words before a program, at least one
};

/// @return [hosts.*] @throws ConfigError  a host without `start`
std::vector<Host> read_hosts(const Config& config);

/// Gives every part of another host the words with which it is started there; the others run here.
/// @return whether any part runs elsewhere
/// @throws FaultError bad_configuration  a process that the task does not have, or that two hosts have
bool assign_hosts(const std::vector<Host>& hosts, std::vector<Part>& parts);

}  // namespace mrroc::mp
