#include "bench/task_process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>

#include "base/fault.hpp"
#include "base/file_content.hpp"
#include "base/program.hpp"

namespace mrroc::bench {
namespace fs = std::filesystem;
namespace {

/// State and parent of a process, from /proc/PID/stat: "PID (name) STATE PARENT ..."
struct ProcessStat {
  char state{};
  pid_t parent{};
};
ProcessStat stat_of(const fs::path& process) {
  const std::string text = file_content(process / "stat");
  ProcessStat s;
  const auto after_name = text.rfind(')');
  if (after_name != std::string::npos) std::istringstream(text.substr(after_name + 1)) >> s.state >> s.parent;
  return s;
}

}  // namespace

TaskProcess::TaskProcess(const std::string& program, const std::vector<std::string>& arguments,
                         std::chrono::milliseconds timeout)
    : program_(program), timeout_(timeout) {
  std::vector<std::string> words{(program_folder() / program).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0)
    throw FaultError(FaultCode::start_failed, fmt::format("cannot make a pipe: {}", std::strerror(errno)));
  pid_ = ::fork();
  if (pid_ == 0) {
    ::dup2(ends[1], STDOUT_FILENO);
    const int nothing = ::open("/dev/null", O_WRONLY);
    if (nothing >= 0) ::dup2(nothing, STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ::close(ends[1]);
  output_ = ends[0];
  if (pid_ < 0) throw FaultError(FaultCode::start_failed, "cannot start " + words[0]);
}

TaskProcess::~TaskProcess() {
  kill();
  ::close(output_);
}

void TaskProcess::kill() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  ::waitpid(pid_, nullptr, 0);
  pid_ = 0;
}

void TaskProcess::give_up() {
  kill();
  throw FaultError(FaultCode::peer_silent,
                   fmt::format("{} has said nothing for {} s and has been ended", program_,
                               std::chrono::duration<double>(timeout_).count()));
}

bool TaskProcess::read_line(std::string& line) {
  while (true) {
    if (const auto end = buffer_.find('\n'); end != std::string::npos) {
      line = buffer_.substr(0, end);
      buffer_.erase(0, end + 1);
      return true;
    }
    pollfd file{output_, POLLIN, 0};
    if (::poll(&file, 1, static_cast<int>(timeout_.count())) == 0) give_up();
    char part[4096];
    const auto n = ::read(output_, part, sizeof part);
    if (n <= 0) return false;
    buffer_.append(part, static_cast<std::size_t>(n));
  }
}

bool TaskProcess::read_until(const std::string& text, std::string* found) {
  for (std::string line; read_line(line);) {
    if (line.find(text) == std::string::npos) continue;
    if (found) *found = line;
    return true;
  }
  return false;
}

int TaskProcess::wait() {
  for (std::string line; read_line(line);) {
  }
  int status = 0;
  const auto deadline = std::chrono::steady_clock::now() + timeout_;
  while (::waitpid(pid_, &status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > deadline) give_up();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  pid_ = 0;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

std::vector<pid_t> TaskProcess::children() const {
  std::vector<pid_t> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (!std::ranges::all_of(name, [](char c) { return c >= '0' && c <= '9'; })) continue;
    if (stat_of(entry.path()).parent == pid_) found.push_back(std::stoi(name));
  }
  return found;
}

pid_t TaskProcess::child(const std::string& word) const {
  for (const pid_t pid : children()) {
    const std::string words = file_content(fs::path("/proc") / std::to_string(pid) / "cmdline");
    if (words.find('\0' + word + '\0') != std::string::npos) return pid;
  }
  return 0;
}

int still_running(const std::vector<pid_t>& processes) {
  const auto runs = [](pid_t pid) {
    const char state = stat_of(fs::path("/proc") / std::to_string(pid)).state;
    return state != '\0' && state != 'Z' && state != 'X';
  };
  std::ptrdiff_t count = 0;
  for (int look = 0; look < 200; ++look) {
    count = std::ranges::count_if(processes, runs);
    if (count == 0) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return static_cast<int>(count);
}

ScratchFolder::ScratchFolder() {
  std::string name = (fs::temp_directory_path() / "mrroc-bench-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) throw FaultError(FaultCode::cannot_write, "no temporary folder");
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

}  // namespace mrroc::bench
