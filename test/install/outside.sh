#!/usr/bin/env bash
# Installs what has been built, builds the example against it, and runs it: outside.sh SOURCE BUILD
set -euo pipefail
source=$1 build=$2
place=$(mktemp -d "${TMPDIR:-/tmp}/mrroc-install.XXXXXX")
trap 'rm -rf "$place"' EXIT

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

cmake --install "$build" --prefix "$place/usr" >"$place/install.log"
grep -rl "$source\|$build" "$place/usr/lib/cmake" && fail "the CMake package points into the tree"

cmake -S "$source/test/install/example" -B "$place/example" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$place/usr" >"$place/configure.log"
cmake --build "$place/example"
"$place/example/bin/touch" --processes one --run-dir "$place/run"
[[ -s $place/run/summary.json ]] || fail "the run has left no summary"

# The reader for Python is there with the definitions of messages.
if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  env -u MRROC_MSG PYTHONDONTWRITEBYTECODE=1 PYTHONPATH="$place/usr/lib/python3/dist-packages" /usr/bin/python3 -c '
import mrroc_runs, sys
assert len(mrroc_runs.open_run(sys.argv[1]).messages("arm1.reply")["F_a"]) > 10' "$place/run" || fail "the installed reader does not read"
fi

# Campaigns are started by the name of the installed command.
"$place/usr/bin/mrroc" campaign --help | grep -q 'mrroc campaign TASK --seeds' || fail "there are no campaigns"
if /usr/bin/python3 -c 'import distributed, optuna, scipy, tqdm' 2>/dev/null; then
  "$place/usr/bin/mrroc" campaign press --seeds 1:2 --workers 1 --dir "$place/campaign" | grep '2 of 2 runs' >/dev/null ||
    fail "the installed campaign does not run"
fi

# bash-completion finds the words of ui_cli by the name of the command that is typed.
for name in ui_cli mrroc; do
  bash -c 'source "$1" && complete -p ui_cli mrroc >/dev/null' _ "$place/usr/share/bash-completion/completions/$name" ||
    fail "$name is not completed"
done
[[ -s $place/usr/share/zsh/vendor-completions/_ui_cli ]] || fail "there is no completion for zsh"

# What `ui_cli new` writes for the outside is such a project too.
(cd "$place" && "$place/usr/bin/mrroc" ui_cli new task circle --outside "$place/circle" >/dev/null)
cmake -S "$place/circle" -B "$place/circle/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$place/usr" >"$place/configure.log"
cmake --build "$place/circle/build"
"$place/circle/build/bin/circle" --processes one --run-dir "$place/run-circle"
[[ -s $place/run-circle/summary.json ]] || fail "the run of what was written has left no summary"

"$place/usr/bin/mrroc" --help | grep -qw press || fail "mrroc does not list press"
"$place/usr/bin/mrroc" press --help | grep -q 'Usage: mrroc press' || fail "the help does not tell how it was called"
if "$place/usr/bin/mrroc" pres 2>"$place/error"; then fail "a program that does not exist was run"; fi
grep -q bad_usage "$place/error" || fail "no reason was given"
