#include <dlfcn.h>
#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/link/lcm_bus.hpp"
#include "base/link/session.hpp"
#include "ui_cli/doctor.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kUnlimited = std::int64_t{1} << 40;
/// A process of the framework is smaller than this [bytes].
constexpr std::size_t kLocked = std::size_t{64} << 20;

std::int64_t number_in(const fs::path& file) {
  std::int64_t number = 0;
  std::ifstream(file) >> number;
  return number;
}

bool installed(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

bool loadable(const char* library) {
  void* const handle = ::dlopen(library, RTLD_LAZY);
  if (handle) ::dlclose(handle);
  return handle != nullptr;
}

std::int64_t limit_of(int resource) {
  rlimit limit{};
  if (::getrlimit(static_cast<__rlimit_resource_t>(resource), &limit) != 0) return 0;
  return limit.rlim_cur == RLIM_INFINITY ? kUnlimited : static_cast<std::int64_t>(limit.rlim_cur);
}

std::int64_t latest_wake_us() {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kSleep{1};
  std::int64_t latest = 0;
  for (int k = 0; k < 100; ++k) {
    const auto begin = Clock::now();
    std::this_thread::sleep_for(kSleep);
    const auto late = std::chrono::duration_cast<std::chrono::microseconds>(Clock::now() - begin - kSleep);
    latest = std::max<std::int64_t>(latest, late.count());
  }
  return latest;
}

/// Tries it: what root may do depends on its capabilities, which a container takes away.
int permitted_priority() {
  int best = 0;
  std::thread([&best] {  // which ends with its priority
    for (int priority = ::sched_get_priority_max(SCHED_FIFO); priority > 0 && best == 0; --priority) {
      const sched_param wanted{.sched_priority = priority};
      if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted) == 0) best = priority;
    }
  })
      .join();
  return best;
}

/// Locks as much as a process may have, and gives it back. With a finite limit no process of the framework locks anything
/// (base/link/real_time.cpp), root's neither.
bool may_lock_memory() {
  if (limit_of(RLIMIT_MEMLOCK) < kUnlimited) return false;
  void* const room = ::mmap(nullptr, kLocked, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (room == MAP_FAILED) return false;
  const bool locked = ::mlock(room, kLocked) == 0;
  ::munmap(room, kLocked);
  return locked;
}

}  // namespace

Host look_at_host() {
  Host h;
  h.multicast = link::multicast_works(link::address_for("doctor"));
  h.receive_buffer = number_in("/proc/sys/net/core/rmem_max");
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  h.clock_resolution_ns = resolution.tv_sec * 1'000'000'000 + resolution.tv_nsec;
  h.latest_wake_us = latest_wake_us();
  cpu_set_t cores;
  CPU_ZERO(&cores);
  h.cores = ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
  h.real_time_priority = permitted_priority();
  h.memory_lock = may_lock_memory();
  for (const Needed& n : kNeeded)
    if (!(n.library ? loadable(n.name) : installed(n.name))) h.missing.emplace_back(n.name);
  std::error_code failed;
  h.folder = fs::current_path(failed);
  const fs::space_info space = fs::space(h.folder, failed);
  h.free_bytes = failed ? 0 : static_cast<std::int64_t>(space.available);
  return h;
}

}  // namespace mrroc::ui
