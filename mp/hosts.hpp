// Assigns processes of a task to hosts, as the configuration says:
//
//   [hosts.robot]
//   processes = ["simulator", "edp-arm1"]
//
// How a program starts there is said by hand, as a configuration may come from somebody else:
//
//   --host "robot=ssh robot"
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

/// @param given  texts NAME=WORDS of the command line; blanks are between words
/// @return [hosts.*]
/// @throws ConfigError  a host that says in the configuration how programs start
/// @throws FaultError bad_configuration: it was not given how programs start on a host that has processes; bad_usage: a text
///         has another form, names no host of the configuration, or one for a second time
std::vector<Host> read_hosts(const Config& config, const std::vector<std::string>& given);

/// Gives every node of another host the words with which it is started there; the others run here.
/// @return whether any node runs elsewhere
/// @throws FaultError bad_configuration  a process that the task does not have, or that two hosts have
bool assign_hosts(const std::vector<Host>& hosts, std::vector<NodeSpec>& nodes);

/// @return what is run on that host, for a person to read before it is
[[nodiscard]] std::string announcement(const Host& host);

}  // namespace mrroc::mp
