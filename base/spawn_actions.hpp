// What a program that is started by posix_spawn() finds: its folder and its standard streams.
#pragma once
#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <string>

namespace mrroc {

/// Actions in the child before the program starts. Its standard input is empty; its outputs are those of this process
/// unless they are sent elsewhere.
class SpawnActions {
 public:
  /// @param folder  where the program runs; empty: where this process does
  explicit SpawnActions(const std::string& folder) {
    posix_spawn_file_actions_init(&actions_);
    if (!folder.empty()) posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;

  /// The standard output goes into an open file, a pipe for instance.
  void send_output(int file) { posix_spawn_file_actions_adddup2(&actions_, file, STDOUT_FILENO); }
  /// Both outputs are appended to a file. @param file  relative to the folder
  void append_outputs(const std::string& file) {
    posix_spawn_file_actions_addopen(&actions_, STDOUT_FILENO, file.c_str(), O_WRONLY | O_CREAT | O_APPEND,
                                     0644);
    posix_spawn_file_actions_adddup2(&actions_, STDOUT_FILENO, STDERR_FILENO);
  }

  /// @return for posix_spawn()
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

}  // namespace mrroc
