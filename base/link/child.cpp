#include "base/link/child.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <csignal>
#include <cstring>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent, int error_pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(3);  // the parent has died already
  ::setpgid(0, 0);                        // a Ctrl-C in the terminal is the parent's business
  // Who reads the terminal from the background is stopped, and ssh reads.
  if (const int nothing = ::open("/dev/null", O_RDONLY); nothing >= 0) ::dup2(nothing, STDIN_FILENO);
  ::execvp(program, arguments);  // a path with a slash is not searched for
  const int reason = errno;
  [[maybe_unused]] const auto written = ::write(error_pipe, &reason, sizeof reason);
  ::_exit(3);
}

/// ssh joins its words to one line for a shell over there.
bool goes_through_shell(const std::vector<std::string>& start) {
  return std::ranges::any_of(
      start, [](const std::string& w) { return std::filesystem::path(w).filename() == "ssh"; });
}

/// @return the word as a shell must read it
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

}  // namespace

Child::Child(const std::filesystem::path& program, const std::vector<std::string>& arguments,
             const std::vector<std::string>& start) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (goes_through_shell(start)) std::ranges::transform(words, words.begin(), quoted);
  words.insert(words.begin(), start.begin(), start.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);

  int error_pipe[2];
  if (::pipe2(error_pipe, O_CLOEXEC) != 0) throw FaultError(FaultCode::start_failed, "cannot make a pipe");
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  if (pid_ == 0) become(argv[0], argv.data(), parent, error_pipe[1]);
  ::close(error_pipe[1]);
  int reason = 0;
  const bool failed = pid_ < 0 || ::read(error_pipe[0], &reason, sizeof reason) > 0;
  ::close(error_pipe[0]);
  if (!failed) return;
  if (pid_ > 0) ::waitpid(pid_, nullptr, 0);
  throw FaultError(FaultCode::start_failed,
                   fmt::format("cannot start {}: {}", words[0], std::strerror(reason)));
}

Child::Child(Child&& other) noexcept : pid_(other.pid_), ended_(std::move(other.ended_)), well_(other.well_) {
  other.pid_ = 0;
}

Child::~Child() {
  if (pid_ <= 0 || ended_) return;
  kill();
  ::waitpid(pid_, nullptr, 0);
}

bool Child::reap() {
  int status = 0;
  if (ended_ || ::waitpid(pid_, &status, WNOHANG) != pid_) return false;
  well_ = WIFEXITED(status) && WEXITSTATUS(status) == 0;
  ended_ = WIFSIGNALED(status)
               ? fmt::format("signal {} ({})", WTERMSIG(status), ::strsignal(WTERMSIG(status)))
               : fmt::format("exit status {}", WEXITSTATUS(status));
  return true;
}

void Child::kill() {
  if (!ended_) ::kill(pid_, SIGKILL);
}

}  // namespace mrroc::link
