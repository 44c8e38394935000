#include "bench/terminal_program.hpp"

#include <poll.h>
#include <pty.h>
#include <sys/wait.h>
#include <unistd.h>
#include <csignal>

#include <cstdlib>
#include <filesystem>
#include <regex>

#include "base/fault.hpp"
#include "base/program.hpp"

namespace mrroc::bench {
namespace {

constexpr int kLook = 10;  // [ms] between looks at whether to leave

}  // namespace

TerminalProgram::TerminalProgram(const std::string& program, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{(program_folder() / program).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  winsize size{};
  size.ws_row = 24;
  size.ws_col = 80;
  pid_ = ::forkpty(&terminal_, nullptr, nullptr, &size);
  if (pid_ == 0) {
    ::setenv("TERM", "xterm", 1);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  if (pid_ < 0) throw FaultError(FaultCode::start_failed, "cannot start " + words[0] + " in a terminal");
  reader_ = std::thread([this] { read(); });
}

TerminalProgram::~TerminalProgram() {
  leave_ = true;
  reader_.join();
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  ::close(terminal_);
}

TerminalProgram::Clock::time_point TerminalProgram::press(char key) {
  {
    const std::lock_guard lock(mutex_);
    written_.clear();
  }
  const auto now = Clock::now();
  if (::write(terminal_, &key, 1) != 1) throw FaultError(FaultCode::internal_error, "the terminal is gone");
  return now;
}

bool TerminalProgram::await(const std::string& text, std::chrono::milliseconds timeout) {
  const auto deadline = Clock::now() + timeout;
  while (Clock::now() < deadline) {
    {
      const std::lock_guard lock(mutex_);
      if (written_.find(text) != std::string::npos) return true;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return false;
}

std::string TerminalProgram::written() {
  static const std::regex moves("(\x1b(\\[[0-9;?]*[a-zA-Z]|[()].|.)|[^ -~])+");
  const std::lock_guard lock(mutex_);
  return std::regex_replace(written_, moves, " ");
}

void TerminalProgram::read() {
  pollfd file{terminal_, POLLIN, 0};
  while (!leave_) {
    if (::poll(&file, 1, kLook) <= 0) continue;
    char part[4096];
    const auto n = ::read(terminal_, part, sizeof part);
    if (n <= 0) return;
    const std::lock_guard lock(mutex_);
    written_.append(part, static_cast<std::size_t>(n));
  }
}

}  // namespace mrroc::bench
