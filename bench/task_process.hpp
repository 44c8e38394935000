// A task in processes of its own, watched and disturbed from outside.
#pragma once
#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace mrroc::bench {

/// A running program whose standard output is read line by line.
class TaskProcess {
 public:
  /// @param program    name of a program in the folder of this one
  /// @param timeout    for its next line, and for its end after the last one; then it is killed
  /// @throws FaultError start_failed
  TaskProcess(const std::string& program, const std::vector<std::string>& arguments,
              std::chrono::milliseconds timeout = std::chrono::minutes(30));
  /// Kills it if it runs.
  ~TaskProcess();
  TaskProcess(const TaskProcess&) = delete;
  TaskProcess& operator=(const TaskProcess&) = delete;

  /// Reads lines until one contains the text. @param found  gets that line @return false when the output ended before
  /// @throws FaultError peer_silent
  bool read_until(const std::string& text, std::string* found = nullptr);
  /// Reads the rest of the output and waits for the end. @return exit status; 128 + number of a signal
  /// @throws FaultError peer_silent
  int wait();
  /// @return the program's direct children
  [[nodiscard]] std::vector<pid_t> children() const;
  /// @return the direct child with this word in its command line, or 0
  [[nodiscard]] pid_t child(const std::string& word) const;
  /// @return the program itself
  [[nodiscard]] pid_t pid() const { return pid_; }

 private:
  bool read_line(std::string& line);
  void kill();
  [[noreturn]] void give_up();

  std::string program_;
  std::chrono::milliseconds timeout_;
  pid_t pid_{};
  int output_{-1};
  std::string buffer_;
};

/// @return how many of the processes still run; waits for their end for up to two seconds
int still_running(const std::vector<pid_t>& processes);

/// A folder that is removed with all that is in it.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  /// @return of the folder, absolute
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace mrroc::bench
