#include "mp/gnuplot.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

namespace mrroc::mp {
namespace {

// Where the child's standard streams go and where it runs.
class FileActions {
 public:
  FileActions(const std::string& folder, const std::string& log) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                     0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }
  ~FileActions() { posix_spawn_file_actions_destroy(&actions_); }
  FileActions(const FileActions&) = delete;
  FileActions& operator=(const FileActions&) = delete;

  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace

GnuplotResult run_gnuplot(const std::filesystem::path& folder, const std::filesystem::path& script) {
  const std::filesystem::path log = script.parent_path() / "gnuplot.log";
  std::string program = "gnuplot";
  std::string argument = script.string();
  const std::array<char*, 3> argv{program.data(), argument.data(), nullptr};
  const FileActions actions(folder.string(), log.string());
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), actions.get(), nullptr, argv.data(), environ);
  if (error == ENOENT) return GnuplotResult::absent;
  if (error != 0) return GnuplotResult::failed;
  int status = 0;
  pid_t ended = 0;
  do ended = waitpid(child, &status, 0);
  while (ended < 0 && errno == EINTR);
  std::error_code ignored;
  if (std::filesystem::file_size(folder / log, ignored) == 0) std::filesystem::remove(folder / log, ignored);
  return ended == child && WIFEXITED(status) && WEXITSTATUS(status) == 0 ? GnuplotResult::done
                                                                         : GnuplotResult::failed;
}

}  // namespace mrroc::mp
