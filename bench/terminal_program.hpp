// A program in a terminal of its own, whose keys are pressed by the benchmark.
#pragma once
#include <sys/types.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace mrroc::bench {

/// A program of the folder of this one that runs in a pseudo terminal of 80 columns and 24 rows.
class TerminalProgram {
 public:
  using Clock = std::chrono::steady_clock;  ///< wall time

  /// @throws FaultError start_failed
  TerminalProgram(const std::string& program, const std::vector<std::string>& arguments);
  /// Kills it if it runs.
  ~TerminalProgram();
  TerminalProgram(const TerminalProgram&) = delete;
  TerminalProgram& operator=(const TerminalProgram&) = delete;

  /// Forgets what was written, then writes the key's byte into the terminal.
  /// @return the moment before the byte was written
  Clock::time_point press(char key);
  /// @param text  without spaces: a screen moves over cells that stay as they are
  /// @return whether the program writes it, since the last key, within the timeout
  bool await(const std::string& text, std::chrono::milliseconds timeout);
  /// @return what it has written since the last key: printable characters, a blank for what moves the cursor
  [[nodiscard]] std::string written();

 private:
  void read();

  pid_t pid_{};
  int terminal_{-1};
  std::atomic<bool> leave_{false};
  std::mutex mutex_;
  std::string written_;
  std::thread reader_;
};

}  // namespace mrroc::bench
