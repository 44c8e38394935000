#include "base/command_hint.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "base/program.hpp"

namespace mrroc {
namespace {

constexpr std::string_view kTerminal = "ui_cli", kScript = "./run", kUsage = "Usage: ";

/// Commands of ui_cli that speak with a session.
constexpr std::array<std::string_view, 10> kWithSession{"",       "watch",   "status", "start",  "pause",
                                                        "resume", "trigger", "stop",   "e-stop", "manual"};

std::string_view first_word(std::string_view line) { return line.substr(0, line.find(' ')); }

std::string_view behind_first_word(std::string_view line) {
  return line.substr(std::min(line.size(), first_word(line).size() + 1));
}

bool lacks_session(std::string_view command) {
  const auto has = [&](std::string_view option) { return command.find(option) != std::string_view::npos; };
  return first_word(command) == kTerminal && !has(" --session") && !has(" --help") &&
         std::ranges::count(kWithSession, first_word(behind_first_word(command))) > 0;
}

bool is_command(std::string_view text) {
  const std::string_view name = first_word(text);
  return name == kTerminal ||
         (name != text && (name == kScript || name == this_program().filename().string()));
}

}  // namespace

std::string typed(std::string_view command, std::string_view session) {
  const char* const set = std::getenv(kCalledVariable);
  const std::string caller = set ? set : "";
  const std::string_view bare = first_word(command) == kScript ? behind_first_word(command) : command;
  std::string line(caller.empty() ? command : bare);
  if (!caller.empty()) line.insert(0, caller + ' ');
  if (!session.empty() && lacks_session(bare)) line.append(" --session ").append(session);
  return line;
}

std::string command_hint(std::string_view text, std::string_view session) {
  std::string result;
  const auto take = [&](char end, bool command) {
    const std::string_view part = text.substr(0, text.find(end));
    result += command && is_command(part) ? typed(part, session) : std::string(part);
    text.remove_prefix(part.size());
  };
  if (const std::size_t usage = text.find(kUsage); usage != std::string_view::npos) {
    result = command_hint(text.substr(0, usage), session).append(kUsage);
    text.remove_prefix(usage + kUsage.size());
    take('\n', true);
  }
  for (bool quoted = false; !text.empty(); quoted = !quoted) {
    take('`', quoted);
    if (text.empty()) break;
    result += '`';
    text.remove_prefix(1);
  }
  return result;
}

}  // namespace mrroc
