#include "ui_cli/completion.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace mrroc::ui {
namespace {

constexpr const char* kSessions =
    "$(ui_cli list --json 2>/dev/null | sed -n 's/.*\\\"session\\\": \\\"\\([^\\\"]*\\)\\\".*/\\1/p')";

/// A text within single quotation marks of a shell.
std::string quoted(const std::string& text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += "'\\''";
    } else {
      result += c;
    }
  }
  return result + "'";
}

}  // namespace

std::string bash_completion(std::span<const CompletedCommand> commands) {
  std::string names, cases;
  for (const CompletedCommand& c : commands) {
    names += (names.empty() ? "" : " ") + c.name;
    cases += fmt::format("    {}) words={} ;;\n", c.name, quoted(fmt::format("{}", fmt::join(c.words, " "))));
  }
  return fmt::format(
      "# Completion of ui_cli for bash:  source <(ui_cli completion bash)\n"
      "_ui_cli() {{\n"
      "  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words={0}\n"
      "  if [[ $before == --session ]]; then\n"
      "    COMPREPLY=($(compgen -W \"{2}\" -- \"$current\"))\n    return\n  fi\n"
      "  if ((COMP_CWORD > 1)); then\n    case ${{COMP_WORDS[1]}} in\n{1}    esac\n  fi\n"
      "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
      "}}\n"
      "complete -o bashdefault -o default -F _ui_cli ui_cli\n",
      quoted(names), cases, kSessions);
}

std::string zsh_completion(std::span<const CompletedCommand> commands) {
  std::string names, cases;
  for (const CompletedCommand& c : commands) {
    std::string about = c.about;
    for (std::size_t at = about.find(':'); at != std::string::npos; at = about.find(':', at + 2))
      about.insert(at, "\\");
    names += fmt::format("    {}\n", quoted(c.name + ":" + about));
    std::string words;
    for (const std::string& w : c.words) words += " " + quoted(w);
    cases += fmt::format("    {}) compadd --{}; _files ;;\n", c.name, words);
  }
  return fmt::format(
      "#compdef ui_cli\n"
      "# Completion of ui_cli for zsh:  source <(ui_cli completion zsh)\n"
      "_ui_cli() {{\n"
      "  local -a commands\n  commands=(\n{0}  )\n"
      "  if [[ $words[CURRENT-1] == --session ]]; then compadd -- {2}; return; fi\n"
      "  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
      "  case $words[2] in\n{1}  esac\n"
      "}}\n"
      "compdef _ui_cli ui_cli\n",
      names, cases, kSessions);
}

}  // namespace mrroc::ui
