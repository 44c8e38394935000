#include "bench/own_output.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

#include "base/fault.hpp"

namespace mrroc::bench {

OwnOutput::OwnOutput() : file_(::fcntl(STDOUT_FILENO, F_DUPFD_CLOEXEC, STDERR_FILENO + 1)) {
  std::fflush(stdout);
  ::dup2(STDERR_FILENO, STDOUT_FILENO);
}

OwnOutput::~OwnOutput() {
  std::fflush(stdout);
  ::dup2(file_, STDOUT_FILENO);
  ::close(file_);
}

void OwnOutput::write(std::string_view text) const {
  while (!text.empty()) {
    const ssize_t n = ::write(file_, text.data(), text.size());
    if (n < 0) throw FaultError(FaultCode::cannot_write, "cannot write on the standard output");
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

}  // namespace mrroc::bench
