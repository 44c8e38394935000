#include "base/link/real_time.hpp"

#include <fmt/core.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace mrroc::link {
namespace {

/// Tries it: root of a user namespace has the capability CAP_IPC_LOCK there, and the limit holds for it all the same.
bool locks_more_than(rlim_t limit) {
  const auto page = static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  const rlim_t size = limit / page * page + page;
  if (size < limit) return false;
  void* const memory =
      ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (memory == MAP_FAILED) return false;
  const bool locked = ::mlock2(memory, size, MLOCK_ONFAULT) == 0;  // takes no page before it is used
  ::munmap(memory, size);
  return locked;
}

}  // namespace

bool may_keep_in_memory() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_MEMLOCK, &limit) != 0) return false;
  // With a limit that holds, MCL_FUTURE would let a later allocation fail.
  return limit.rlim_cur == RLIM_INFINITY || locks_more_than(limit.rlim_cur);
}

bool keep_in_memory() { return may_keep_in_memory() && ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0; }

std::string become_real_time(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const bool scheduled = ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  const bool locked = keep_in_memory();
  return fmt::format(
      "{}, {}",
      scheduled ? fmt::format("scheduler SCHED_FIFO, priority {}", priority) : "SCHED_FIFO is not permitted",
      locked ? "memory locked" : "locked memory is not permitted");
}

bool pin_to_core(int core) {
  if (core < 0 || core >= CPU_SETSIZE) return false;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(static_cast<std::size_t>(core), &cores);
  return ::sched_setaffinity(0, sizeof cores, &cores) == 0;
}

void become_background(int nice) {
  const sched_param parameters{};
  ::sched_setscheduler(0, SCHED_OTHER, &parameters);  // of this thread, like the next one
  ::setpriority(PRIO_PROCESS, 0, nice);
}

}  // namespace mrroc::link
