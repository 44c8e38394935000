#include "mp/print_line.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <fmt/core.h>

#include "base/command_hint.hpp"
#include "base/print.hpp"
#include "base/wrap.hpp"

namespace mrroc::mp {
namespace {

/// @return columns of standard output; 0: it is no terminal, or one that does not say
int terminal_width() {
  winsize size{};
  const bool known = ::isatty(STDOUT_FILENO) == 1 && ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0;
  return known ? size.ws_col : 0;
}

}  // namespace

std::string folded(std::string_view line, int width) {
  if (width <= 0 || line.size() <= static_cast<std::size_t>(width)) return std::string(line);
  constexpr std::string_view kTime = " s  ";
  constexpr std::size_t kTimeEnds = 12, kIndent = 2;
  const std::size_t time = line.find(kTime);
  const bool timed = time != std::string_view::npos && time + kTime.size() <= kTimeEnds;
  const std::size_t indent = timed ? time + kTime.size() : kIndent;
  std::string text(line.substr(0, timed ? indent : 0));
  std::string before;
  for (const std::string& part : wrap(line.substr(text.size()), width - static_cast<int>(indent))) {
    text += before + part;
    before = '\n' + std::string(indent, ' ');
  }
  return text;
}

void print_line(std::string_view line, std::string_view session) {
  print(stdout, folded(command_hint(line, session), terminal_width()) + "\n");
}

Announcer::Announcer(link::Process& process, std::string session, bool shown)
    : process_(process), session_(std::move(session)), shown_(shown) {}

void Announcer::operator()(double sim_s, const std::string& text) const {
  constexpr int kRoom = sizeof(console_t::text);
  for (const std::string& part : wrap(text, kRoom)) process_.log(part);
  if (shown_) print_line(fmt::format("{:8.2f} s  {}", sim_s, text), session_);
}

}  // namespace mrroc::mp
