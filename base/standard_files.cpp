#include "base/standard_files.hpp"

#include <poll.h>

#include <cstdio>

#include "base/fault.hpp"
#include "base/print.hpp"

namespace mrroc {
namespace {

/// @return whether standard output is a pipe, socket or terminal whose other end is closed
bool nobody_reads() {
  pollfd output{.fd = STDOUT_FILENO, .events = POLLOUT, .revents = 0};
  return ::poll(&output, 1, 0) == 1 && (output.revents & (POLLERR | POLLHUP)) != 0;
}

}  // namespace

int end_standard_output(int status) {
  const bool written = std::fflush(stdout) == 0 && std::ferror(stdout) == 0;
  if (written || status != 0 || nobody_reads()) return status;
  const FaultError error(FaultCode::cannot_write, "the standard output cannot be written",
                         "look at the rights and the space left where it goes");
  print(stderr, error.error_line() + "\n");
  return exit_status(FaultCode::cannot_write);
}

}  // namespace mrroc
