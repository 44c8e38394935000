#include "test/base/link/short_transfers.hpp"

#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace {

thread_local std::size_t most_bytes = 0;  // 0: as many as are asked for
thread_local std::size_t transfers = 0;

/// @return bytes to move now; 0: the call is interrupted
std::size_t allowed(std::size_t wanted) {
  if (most_bytes == 0) return wanted;
  return ++transfers % 3 == 0 ? 0 : std::min(wanted, most_bytes);
}

ssize_t interrupted() {
  errno = EINTR;
  return -1;
}

}  // namespace

// What stands for the C library's.
// NOLINTBEGIN(readability-inconsistent-declaration-parameter-name): its header has names of its own
extern "C" ssize_t pread(int file, void* into, std::size_t size, off_t place) {
  const std::size_t now = allowed(size);
  return now == 0 && size > 0 ? interrupted() : ::syscall(SYS_pread64, file, into, now, place);
}
extern "C" ssize_t pwrite(int file, const void* from, std::size_t size, off_t place) {
  const std::size_t now = allowed(size);
  return now == 0 && size > 0 ? interrupted() : ::syscall(SYS_pwrite64, file, from, now, place);
}
// NOLINTEND(readability-inconsistent-declaration-parameter-name)

namespace mrroc::link::test {

ShortTransfers::ShortTransfers(std::size_t most) noexcept {
  most_bytes = most;
  transfers = 0;
}
ShortTransfers::~ShortTransfers() { most_bytes = 0; }
std::size_t ShortTransfers::calls() noexcept { return transfers; }

}  // namespace mrroc::link::test
