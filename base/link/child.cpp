#include "base/link/child.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "base/fault.hpp"

namespace mrroc::link {
namespace {

/// In the child, between fork and exec: only calls that are safe there.
[[noreturn]] void become(const char* program, char* const* arguments, pid_t parent, int input,
                         int error_pipe) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(3);  // the parent has died already
  ::setpgid(0, 0);                        // a Ctrl-C in the terminal is the parent's business
  // A process that reads the terminal from the background is stopped, and ssh reads.
  ::dup2(input, STDIN_FILENO);
  ::fcntl(STDIN_FILENO, F_SETFD, 0);  // it may have had that number already
  ::execvp(program, arguments);       // a path with a slash is not searched for
  const int reason = errno;
  [[maybe_unused]] const auto written = ::write(error_pipe, &reason, sizeof reason);
  ::_exit(3);
}

/// @param reason  as errno
[[noreturn]] void refuse_without_pipe(int reason) {
  throw FaultError(FaultCode::start_failed, fmt::format("cannot make a pipe: {}", std::strerror(reason)));
}

/// @return the end from which the text can be read once; then it has ended
int pipe_with(const std::string& text) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) refuse_without_pipe(errno);
  const bool written =
      text.empty() || ::write(ends[1], text.data(), text.size()) == static_cast<ssize_t>(text.size());
  ::close(ends[1]);
  ::fcntl(ends[0], F_SETFL, 0);  // the reader may wait
  if (written) return ends[0];
  ::close(ends[0]);
  throw FaultError(FaultCode::start_failed, "what a program is to read does not fit into a pipe");
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
             const std::vector<std::string>& start, const std::string& input) {
  std::vector<std::string> words{program.string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  if (goes_through_shell(start)) std::ranges::transform(words, words.begin(), quoted);
  words.insert(words.begin(), start.begin(), start.end());
  std::vector<char*> argv;
  for (std::string& w : words) argv.push_back(w.data());
  argv.push_back(nullptr);

  const int standard_input = pipe_with(input);
  int error_pipe[2];
  if (::pipe2(error_pipe, O_CLOEXEC) != 0) {
    const int without_pipe = errno;
    ::close(standard_input);
    refuse_without_pipe(without_pipe);
  }
  const pid_t parent = ::getpid();
  pid_ = ::fork();
  int reason = errno;  // of no child at all; a child tells its own
  if (pid_ == 0) become(argv[0], argv.data(), parent, standard_input, error_pipe[1]);
  ::close(standard_input);
  ::close(error_pipe[1]);
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

void Child::terminate() {
  if (!ended_) ::kill(pid_, SIGTERM);
}

void Child::kill() {
  if (!ended_) ::kill(pid_, SIGKILL);
}

}  // namespace mrroc::link
