// The standard files at a program's beginning and end.
#pragma once
#include <fcntl.h>
#include <unistd.h>

namespace mrroc {

/// Opens those of the three standard files that are closed on /dev/null. Otherwise the next file that the program opens,
/// such as its log, would be standard output, and what is told to a person would be written into it. Call it first.
inline void keep_standard_files() {
  for (int file = STDIN_FILENO; file <= STDERR_FILENO; ++file) {
    if (::fcntl(file, F_GETFD) != -1) continue;
    // The lowest number that is free is this one.
    [[maybe_unused]] const int opened = ::open("/dev/null", file == STDIN_FILENO ? O_RDONLY : O_WRONLY);
  }
}

/// Writes out what standard output still holds. Call it last: the status is that of the program. Nobody may be there to
/// read it, as behind `| head -1`: that is no error.
/// @param status  exit status so far
/// @return the same, but for 0 that of cannot_write, which is told, when the output could not be written
[[nodiscard]] int end_standard_output(int status);

}  // namespace mrroc
