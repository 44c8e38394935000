#include "mp/viewer.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <string>

#include "base/program.hpp"

namespace mrroc::mp {
namespace {

constexpr std::chrono::seconds kTimeout{3};

/// In the grandchild, between fork and exec: only calls that are safe there.
[[noreturn]] void become(char* const* words, int out, int nothing) {
  ::dup2(nothing, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(nothing, STDERR_FILENO);
  ::execv(words[0], words);
  ::_exit(3);
}

/// Starts a program that is nobody's child: its end is not noticed, a Ctrl-C in the terminal does not reach it.
void start_apart(char* const* words, int out, int nothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    if (::fork() == 0) become(words, out, nothing);
    ::_exit(0);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

std::string first_line(int file) {
  const auto deadline = std::chrono::steady_clock::now() + kTimeout;
  std::string line;
  char c = 0;
  while (c != '\n') {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd poll{file, POLLIN, 0};
    if (left.count() <= 0 || ::poll(&poll, 1, static_cast<int>(left.count())) <= 0 ||
        ::read(file, &c, 1) != 1)
      break;
    if (c != '\n') line += c;
  }
  return line;
}

}  // namespace

std::string start_viewer(const std::string& session) {
  std::string program = (program_folder() / "ui_cli").string();
  if (!std::filesystem::exists(program)) return "no viewer: there is no " + program + "; build ui_cli";
  std::string view = "view";
  std::string option = "--session";
  std::string name = session;
  std::string with_task = "--with-task";
  char* const words[] = {program.data(), view.data(), option.data(), name.data(), with_task.data(), nullptr};
  int out[2];
  if (::pipe2(out, O_CLOEXEC) != 0)
    return std::string("no viewer: cannot make a pipe: ") + std::strerror(errno);
  const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
  start_apart(words, out[1], nothing);
  ::close(out[1]);
  ::close(nothing);
  std::string line = first_line(out[0]);
  ::close(out[0]);
  return line.empty()
             ? "no viewer yet: nothing was heard from it; if none comes, try `ui_cli view --session " +
                   session + "`"
             : line;
}

}  // namespace mrroc::mp
