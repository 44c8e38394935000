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
[[ -s $place/usr/lib/python3/dist-packages/mrroc_runs/msg/header_t.lcm ]] || fail "the Python reader lacks the definitions"

# What `ui_cli new` writes for the outside is such a project too.
(cd "$place" && "$place/usr/bin/mrroc" ui_cli new task circle --outside "$place/circle" >/dev/null)
cmake -S "$place/circle" -B "$place/circle/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_PREFIX_PATH="$place/usr" >"$place/configure.log"
cmake --build "$place/circle/build"
"$place/circle/build/bin/circle" --processes one --run-dir "$place/run-circle"
[[ -s $place/run-circle/summary.json ]] || fail "the run of what was written has left no summary"

"$place/usr/bin/mrroc" --help | grep -qw press || fail "mrroc does not list press"
"$place/usr/bin/mrroc" press --help >/dev/null
if "$place/usr/bin/mrroc" pres 2>"$place/error"; then fail "a program that does not exist was run"; fi
grep -q bad_usage "$place/error" || fail "no reason was given"
