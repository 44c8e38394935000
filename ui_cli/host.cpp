#include <dlfcn.h>
#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>
#include <vector>

#include "base/link/authentication.hpp"
#include "base/link/lcm_bus.hpp"
#include "base/link/lcm_packet.hpp"
#include "base/link/private_folder.hpp"
#include "base/link/real_time.hpp"
#include "base/link/session.hpp"
#include "base/program.hpp"
#include "ui_cli/doctor.hpp"
#include "ui_cli/subprocess.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

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

/// The loader's complaint about a library would stand before the findings: it is swallowed.
bool starts(const fs::path& driver) {
  return run_program("sh", {"-c", "exec \"$0\" --help 2>&1", driver.string()}).status == 0;
}

std::vector<BuiltPlatform> built_platforms() {
  std::vector<BuiltPlatform> found;
  std::istringstream names(MRROC_PLATFORMS);
  for (std::string name; names >> name;) {
    const fs::path driver = program_folder() / ("edp_" + name);
    if (::access(driver.c_str(), X_OK) == 0) found.push_back({name, starts(driver)});
  }
  return found;
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

/// What processes of the framework would do, in a thread of its own and for a moment: limits do not tell, nor does being
/// root, in a container without the capabilities.
struct Permitted {
  int priority{};      // of SCHED_FIFO
  bool memory_lock{};  // with the limits that let later allocations succeed
};
Permitted try_out() {
  Permitted permitted;
  std::thread([&permitted] {
    for (int p = ::sched_get_priority_max(SCHED_FIFO); p > 0 && permitted.priority == 0; --p) {
      const sched_param parameters{.sched_priority = p};
      if (::sched_setscheduler(0, SCHED_FIFO, &parameters) == 0) permitted.priority = p;
    }
  }).join();
  permitted.memory_lock = link::may_keep_in_memory() && ::mlockall(MCL_CURRENT) == 0;
  if (permitted.memory_lock) ::munlockall();
  return permitted;
}

double time_of_a_tag_us() {
  using Clock = std::chrono::steady_clock;
  constexpr int kTags = 1000;
  constexpr std::size_t kCommand = 588;  // [bytes]
  const link::TagKey key(link::Key::random());
  const std::vector<std::uint8_t> message(kCommand);
  std::vector<std::uint8_t> datagram;
  std::size_t right = 0;
  const auto begun = Clock::now();
  for (std::uint64_t k = 1; k <= kTags; ++k) {
    link::write_packet(datagram, 1, "doctor.arm1.command", message);
    link::sign(datagram, {1, k}, key);
    right += link::authenticate(datagram, key).has_value();
  }
  const double us = std::chrono::duration<double, std::micro>(Clock::now() - begun).count();
  return right == kTags ? us / kTags : -1;
}

}  // namespace

Host look_at_host() {
  Host h;
  const link::SessionPlace place = link::session_place();
  h.sessions = place.directory;
  h.sessions_note = place.note;
  h.sessions_refused = link::why_no_private_folder(h.sessions);
  h.tag_us = time_of_a_tag_us();
  h.multicast = link::multicast_works(link::address_for("doctor"));
  h.receive_buffer = number_in("/proc/sys/net/core/rmem_max");
  timespec resolution{};
  ::clock_getres(CLOCK_MONOTONIC, &resolution);
  h.clock_resolution_ns = resolution.tv_sec * 1'000'000'000 + resolution.tv_nsec;
  h.latest_wake_us = latest_wake_us();
  cpu_set_t cores;
  CPU_ZERO(&cores);
  h.cores = ::sched_getaffinity(0, sizeof cores, &cores) == 0 ? CPU_COUNT(&cores) : 1;
  const Permitted permitted = try_out();
  h.real_time_priority = permitted.priority;
  h.memory_lock = permitted.memory_lock;
  for (const Needed& n : kNeeded)
    if (!(n.library ? loadable(n.name) : installed(n.name))) h.missing.emplace_back(n.name);
  h.platforms = built_platforms();
  std::error_code failed;
  h.folder = fs::current_path(failed);
  const fs::space_info space = fs::space(h.folder, failed);
  h.free_bytes = failed ? 0 : static_cast<std::int64_t>(space.available);
  return h;
}

}  // namespace mrroc::ui
