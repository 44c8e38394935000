#include "base/link/real_time.hpp"

#include <fmt/format.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>

namespace mrroc::link {
namespace {

/// With a finite limit, MCL_FUTURE would let a later allocation fail.
bool may_lock_everything() {
  rlimit limit{};
  return ::getrlimit(RLIMIT_MEMLOCK, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

}  // namespace

std::string become_real_time(int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  const bool scheduled = ::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0;
  const bool locked = may_lock_everything() && ::mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
  std::string got = scheduled ? fmt::format("scheduler SCHED_FIFO, priority {}", priority) : "";
  if (locked) got += scheduled ? ", memory locked" : "memory locked";
  return got;
}

}  // namespace mrroc::link
