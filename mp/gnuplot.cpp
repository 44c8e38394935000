#include "mp/gnuplot.hpp"

#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <mutex>
#include <string>
#include <system_error>

#include "base/spawn_actions.hpp"

namespace mrroc::mp {
namespace {

std::mutex mutex;  // guards both:
bool allowed = true;
pid_t running = 0;  // the child, not waited for yet: its number is nobody else's. 0: none

/// @return 0, or why it could not be started, as errno
int start(const std::string& script, const SpawnActions& actions) {
  std::string program = "gnuplot", argument = script;
  const std::array<char*, 3> argv{program.data(), argument.data(), nullptr};
  return posix_spawnp(&running, program.c_str(), actions.get(), nullptr, argv.data(), environ);
}

/// @return whether the child ended with exit status 0
bool wait_for(pid_t child) {
  siginfo_t ended{};
  while (waitid(P_PID, static_cast<id_t>(child), &ended, WEXITED | WNOWAIT) != 0 && errno == EINTR) {
  }
  const std::lock_guard lock(mutex);
  running = 0;
  int status = 0;
  return waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

}  // namespace

void allow_gnuplot(bool now) {
  const std::lock_guard lock(mutex);
  allowed = now;
  if (!allowed && running > 0) ::kill(running, SIGKILL);
}

GnuplotResult run_gnuplot(const std::filesystem::path& folder, const std::filesystem::path& script) {
  const std::filesystem::path log = script.parent_path() / "gnuplot.log";
  SpawnActions actions(folder.string());
  actions.append_outputs(log.string());
  pid_t child = 0;
  {
    const std::lock_guard lock(mutex);
    if (!allowed) return GnuplotResult::stopped;
    const int error = start(script.string(), actions);
    if (error != 0) running = 0;
    if (error == ENOENT) return GnuplotResult::absent;
    if (error != 0) return GnuplotResult::failed;
    child = running;
  }
  const bool well = wait_for(child);
  std::error_code ignored;
  if (std::filesystem::file_size(folder / log, ignored) == 0) std::filesystem::remove(folder / log, ignored);
  const std::lock_guard lock(mutex);
  if (well) return GnuplotResult::done;
  return allowed ? GnuplotResult::failed : GnuplotResult::stopped;
}

}  // namespace mrroc::mp
