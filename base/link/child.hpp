// Starts and ends child processes: those of a task, and those of a replay.
#pragma once
#include <sys/types.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mrroc::link {

/// A started program. It ends when this process ends, however that happens.
class Child {
 public:
  /// @param program  path of the executable
  /// @param start    words before it that make it run elsewhere; their first one is searched for in PATH. What follows
  ///                 a program named ssh is quoted: a shell reads it
  /// @param input    what it finds on its standard input, less than a pipe holds
  /// @throws FaultError start_failed
  Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
        const std::vector<std::string>& start = {}, const std::string& input = {});
  ~Child();
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;

  /// @return how it ended ("exit status 3", "signal 9 (Killed)"), or nothing while it runs
  [[nodiscard]] const std::optional<std::string>& ended() const { return ended_; }
  /// @return whether it ended with exit status 0
  [[nodiscard]] bool ended_well() const { return well_; }
  /// Looks whether it has ended. @return whether it is news
  bool reap();
  /// Asks it to end: SIGTERM.
  void terminate();
  /// Ends it at once, also when it is suspended: SIGKILL.
  void kill();

 private:
  pid_t pid_{};
  std::optional<std::string> ended_;
  bool well_{};
};

}  // namespace mrroc::link
