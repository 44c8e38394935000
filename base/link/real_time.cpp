#include "base/link/real_time.hpp"

#include <fmt/core.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>

namespace mrroc::link {
namespace {

bool has_capability(unsigned capability) {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
  return ::syscall(SYS_capget, &header, sets.data()) == 0 &&
         (sets[capability / 32].effective >> (capability % 32) & 1) != 0;
}

}  // namespace

bool may_keep_in_memory() {
  rlimit limit{};
  // With a finite limit, MCL_FUTURE would let a later allocation fail.
  return (::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY) ||
         has_capability(CAP_IPC_LOCK);
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
