// Memory that stays in RAM: asked for only where the system grants it for ever.
#include "base/link/real_time.hpp"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>

namespace mrroc::link {
namespace {

/// Memory of this process that is locked [kB].
long locked() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmLck:")) return std::stol(line.substr(6));
  return -1;
}

bool drop_capabilities() {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> none{};
  return ::syscall(SYS_capset, &header, none.data()) == 0;
}

bool limit_memory_lock(rlim_t most) {
  const rlimit limit{most, most};
  return ::setrlimit(RLIMIT_MEMLOCK, &limit) == 0;
}

/// @return exit status of what has been done in a process of its own
int apart(int (*what)()) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(what());
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

constexpr int kGranted = 10, kLocked = 11, kRefused = 12, kNotHere = 13;

TEST(RealTime, AFiniteLimitLocksNothing) {
  // Later allocations would fail beyond it.
  EXPECT_EQ(apart([] {
              if (!limit_memory_lock(1 << 20) || !drop_capabilities()) return kNotHere;
              if (may_keep_in_memory() || keep_in_memory()) return kGranted;
              return locked() == 0 ? kRefused : kLocked;
            }),
            kRefused);
}

TEST(RealTime, WhatIsGrantedKeepsAllMemoryAlsoWhatComesLater) {
#ifdef MRROC_SANITIZED
  GTEST_SKIP() << "sanitizers let nobody lock memory";
#endif
  const int got = apart([] {
    if (!may_keep_in_memory() && !limit_memory_lock(RLIM_INFINITY)) return kNotHere;
    if (!may_keep_in_memory()) return kRefused;
    if (!keep_in_memory()) return kNotHere;  // there is too little memory for that
    constexpr std::size_t kMore = 1 << 24;
    const long before = locked();
    const bool more =
        ::mmap(nullptr, kMore, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0) != MAP_FAILED;
    return before > 0 && more && locked() >= before + static_cast<long>(kMore / 1024) ? kLocked : kGranted;
  });
  if (got == kNotHere) GTEST_SKIP() << "not permitted here";
  EXPECT_EQ(got, kLocked);
}

TEST(RealTime, TheCapabilityIsAsGoodAsAnInfiniteLimit) {
  const int got = apart([] {
    if (!limit_memory_lock(1 << 20)) return kNotHere;
    const bool with = may_keep_in_memory();
    if (!drop_capabilities()) return kNotHere;
    if (may_keep_in_memory()) return kGranted;
    return with ? kLocked : kNotHere;
  });
  if (got == kNotHere) GTEST_SKIP() << "not permitted here";
  EXPECT_EQ(got, kLocked);
}

// As in a container without privileges: its root has every capability, and the system's limit holds.
TEST(RealTime, RootOfAUserNamespaceLocksNothingBeyondTheLimit) {
  const int got = apart([] {
    if (!limit_memory_lock(1 << 20) || ::unshare(CLONE_NEWUSER) != 0) return kNotHere;
    if (may_keep_in_memory() || keep_in_memory()) return kGranted;
    return locked() == 0 ? kRefused : kLocked;
  });
  if (got == kNotHere) GTEST_SKIP() << "no user namespaces here";
  EXPECT_EQ(got, kRefused);
}

TEST(RealTime, AThreadInTheBackgroundIsInNobodysWayAndLeavesTheOthersAsTheyAre) {
  const int got = apart([] {
    become_real_time(10);  // if it may
    const int policy = ::sched_getscheduler(0), niceness = ::getpriority(PRIO_PROCESS, 0);
    bool right = false;
    std::thread([&right] {
      become_background(5);
      right = ::sched_getscheduler(0) == SCHED_OTHER && ::getpriority(PRIO_PROCESS, 0) == 5;
    }).join();
    return right && ::sched_getscheduler(0) == policy && ::getpriority(PRIO_PROCESS, 0) == niceness
               ? kGranted
               : kRefused;
  });
  EXPECT_EQ(got, kGranted);
}

}  // namespace
}  // namespace mrroc::link
