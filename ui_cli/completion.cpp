#include "ui_cli/completion.hpp"

#include <fmt/core.h>
#include "base/joined.hpp"

namespace mrroc::ui {
namespace {

/// Names of the sessions in what `ui_cli list --json` prints.
constexpr const char* kNames = "sed -n 's/.*\"session\": \"\\([^\"]*\\)\".*/\\1/p'";

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
    names += c.name + " ";
    cases += fmt::format("    {}) words={} ;;\n", c.name, quoted(joined(c.words, " ")));
  }
  return fmt::format(
      R"x(# Completion of ui_cli for bash, also behind `mrroc` and `./run`:  source <(ui_cli completion bash)

# _ui_cli_at K PROGRAM...: the words of ui_cli begin at K; PROGRAM... starts it
_ui_cli_at() {{
  local k=$1 command='' words={0} current=${{COMP_WORDS[COMP_CWORD]}} option
  shift
  option=${{COMP_WORDS[COMP_CWORD-1]}}
  [[ $option != = ]] || option=${{COMP_WORDS[COMP_CWORD-2]}}
  if [[ $option == --session ]]; then
    COMPREPLY=($(compgen -W "$("$@" list --json 2>/dev/null | {2})" -- "$current"))
    return
  fi
  for (( ; k < COMP_CWORD; ++k)); do
    case ${{COMP_WORDS[k]}} in
      --session | --url | --key-file) # and their value, which bash takes apart at = and :
        ((++k))
        [[ ${{COMP_WORDS[k]}} != = ]] || ((++k))
        while [[ ${{COMP_WORDS[k+1]:-}} == : ]]; do ((k += 2)); done
        ;;
      -*) ;;
      *)
        command=${{COMP_WORDS[k]}}
        break
        ;;
    esac
  done
  case $command in
{1}  esac
  COMPREPLY=($(compgen -W "$words" -- "$current"))
}}

_ui_cli() {{ _ui_cli_at 1 "${{COMP_WORDS[0]/#\~/$HOME}}"; }}

_ui_cli_mrroc() {{
  local program=${{COMP_WORDS[0]/#\~/$HOME}}
  if ((COMP_CWORD == 1)); then
    COMPREPLY=($(compgen -W "$("$program" --help 2>/dev/null | sed -n 's/^  //p')" -- "${{COMP_WORDS[1]}}"))
  elif [[ ${{COMP_WORDS[1]}} == ui_cli ]]; then
    _ui_cli_at 2 "$program" ui_cli
  fi
}}

# Only the `run` of a clone.
_ui_cli_run() {{
  local program=${{COMP_WORDS[0]/#\~/$HOME}} clone task words='ui_cli build test bench package clean'
  clone=$(dirname -- "$program")
  [[ -d $clone/ui_cli && -d $clone/tasks ]] || return 0
  if ((COMP_CWORD == 1)); then
    for task in "$clone"/tasks/*/main.cpp; do words+=" $(basename "$(dirname "$task")")"; done
    COMPREPLY=($(compgen -W "$words" -- "${{COMP_WORDS[1]}}"))
  elif [[ ${{COMP_WORDS[1]}} == ui_cli ]]; then
    _ui_cli_at 2 "$clone/build/release/bin/ui_cli"
  fi
}}

complete -o bashdefault -o default -F _ui_cli ui_cli
complete -o bashdefault -o default -F _ui_cli_mrroc mrroc
complete -o bashdefault -o default -F _ui_cli_run run
)x",
      quoted(names + "--session --url --key-file --json --help"), cases, kNames);
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
      R"x(#compdef ui_cli mrroc
# Completion of ui_cli for zsh, also behind `mrroc`:  source <(ui_cli completion zsh)
_ui_cli() {{
  local -a commands program
  local k=2 command=''
  commands=(
{0}  )
  program=(${{words[1]/#\~/$HOME}})
  if [[ ${{words[1]:t}} == mrroc ]]; then
    if ((CURRENT == 2)); then compadd -- $($program --help 2>/dev/null | sed -n 's/^  //p'); return; fi
    if [[ $words[2] != ui_cli ]]; then _files; return; fi
    program+=(ui_cli)
    k=3
  fi
  if [[ $words[CURRENT-1] == --session ]]; then
    compadd -- $($program list --json 2>/dev/null | {2})
    return
  fi
  for (( ; k < CURRENT; ++k)); do
    case $words[k] in
      --session | --url | --key-file) ((++k)) ;;
      -*) ;;
      *) command=$words[k]; break ;;
    esac
  done
  if [[ -z $command ]]; then _describe command commands; return; fi
  case $command in
{1}  esac
}}
if [[ $funcstack[1] == _ui_cli ]]; then _ui_cli "$@"; else compdef _ui_cli ui_cli mrroc; fi
)x",
      names, cases, kNames);
}

}  // namespace mrroc::ui
