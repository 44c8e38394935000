// Signals that do not end a process of the system.
#pragma once
#include <csignal>

namespace mrroc {

/// From now on a write that cannot be done is an error of that write, and not the end of the process: neither where nobody
/// reads any more, nor where a file may grow no longer.
inline void report_failed_writes() {
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace mrroc
