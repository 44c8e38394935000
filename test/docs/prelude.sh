#!/usr/bin/env bash
# Runs the commands in the file PLACE/typed in a made-up clone, in which everything is built: prelude.sh SOURCE BUILD
# PLACE. The programs come from BUILD; ./run is the project's own, with a cmake that finds nothing to build.
set -eu  # no pipefail: grep -q leaves as soon as it has seen enough
source=$1 build=$2 place=$3
clone=$place/clone
export XDG_RUNTIME_DIR=$place/sessions XDG_CACHE_HOME=$place/cache MRROC_SKIP_INSTALL=1 LC_ALL=C.UTF-8 TERM=xterm
export MRROC_CASADI=$build/bin MRROC_MUJOCO=$build/bin # whatever is built is there: nothing is looked for
export PATH=$place/stubs:$build/bin:$PATH
unset DISPLAY

make_clone() {
  mkdir -p "$clone/build/release/bin" "$place/stubs" "$XDG_RUNTIME_DIR" "$XDG_CACHE_HOME"
  tar -C "$source" --exclude=./build --exclude=./runs --exclude=./.git -c . | tar -C "$clone" -x
  ln -s "$build/bin/"* "$clone/build/release/bin"
  touch "$clone/build/release/build.ninja"
  # Tests do not start the tests: ./run test gets the answer of a ctest that has one, and does not run it.
  printf '#!/bin/sh\necho "ninja: no work to do."\n' >"$place/stubs/cmake"
  cat >"$place/stubs/ctest" <<STUB
#!/bin/sh
echo "ctest \$*" >>"$place/ctest.log"
echo '  Test #1: One'
echo '100% tests passed, 0 tests failed out of 1'
STUB
  chmod +x "$place/stubs/"*
}

# made TASK [options]: RUN is a run folder of it, made once for all commands of a document
made() {
  RUN=$place/made-$1
  [[ -s $RUN/summary.json ]] || "$1" --processes one --run-dir "$RUN" "${@:2}" >"$place/made.out" 2>&1
}

# await SECONDS COMMAND...: until the command succeeds
await() {
  local tries=$(($1 * 10))
  shift
  while ! "$@" >/dev/null 2>&1; do
    ((tries-- > 0)) || { echo "waited in vain: $*" && return 1; }
    sleep 0.1
  done
}

# state_is STATE: of the task, not of its processes
state_is() {
  [[ $(ui_cli status --json | python3 -c 'import json, sys; print(json.load(sys.stdin)["state"])') == "$1" ]]
}

# live TASK [options]: the task runs in the background, in real time or SPEED times as fast
live() {
  need_messages
  "$1" --speed "${SPEED:-1}" --run-dir "$place/live-$RANDOM" "${@:2}" >"$place/live.out" 2>&1 &
  await 10 ui_cli status
}
running() {
  live "$@"
  await 10 state_is running
}

# Arms that need not look for their switches.
live_manual() {
  SPEED=20 live manual --set robots.arm1.synchro=known_pose --set robots.arm2.synchro=known_pose
  await 10 ui_cli manual show arm1
}

# in_own_network COMMAND...: root in a root of another file system may make no namespace of users
in_own_network() { if ((EUID == 0)); then unshare -n "$@"; else unshare -rn "$@"; fi; }

# background COMMAND...: it runs until the shell ends
background() {
  : >"$place/background.out"
  "$@" >>"$place/background.out" 2>&1 &
}

# terminal_shows TEXT COMMAND: at last, in a terminal of its own on which nobody types
terminal_shows() {
  : >"$place/screen"
  script -qefc "$2" /dev/null >"$place/screen" &
  await 20 grep -q "$1" "$place/screen"
  kill $!
}

# written NAME: a task that `ui_cli new` has written, with the program of another one in its place: it is not built here.
# What is written is built, tested and run by test/new/generated.sh.
written() {
  [[ -e tasks/$1/main.cpp ]]
  ln -sf "$build/bin/press" "build/release/bin/$1"
}

# fetch ADDRESS: prints the page
fetch() { python3 -c 'import sys, urllib.request; print(urllib.request.urlopen(sys.argv[1]).read().decode())' "$1"; }

# fails STATUS COMMAND...: it has to end with that status
fails() {
  local wanted=$1 status=0
  shift
  "$@" || status=$?
  [[ $status == "$wanted" ]] || { echo "ended with $status, not $wanted: $*" && return 1; }
}

# need COMMAND...: a host without it cannot try this
need() {
  local name
  for name in "$@"; do command -v "$name" >/dev/null || { echo "no $name" && exit 77; }; done
}
need_messages() {
  ui_cli doctor | grep -q '^multicast *ok' || { echo "no multicast" && exit 77; }
}

# What ./run campaign installs.
need_dask() {
  /usr/bin/python3 -c 'import distributed, optuna, scipy, tqdm' 2>/dev/null || { echo "no Dask" && exit 77; }
}

# address is that of a scheduler on this host, with a new key
dask_scheduler() {
  rm -f cell.key
  background ./run campaign scheduler --port 0 --key-file cell.key
  await 20 grep -q 'scheduler: tls://127.0.0.1' "$place/background.out"
  # shellcheck disable=SC2034  # for who calls
  address=$(grep -o 'tls://.*' "$place/background.out")
}

finish() {
  local status=$?
  trap - EXIT
  local pids
  mapfile -t pids < <(jobs -p)
  if ((${#pids[@]})); then
    kill "${pids[@]}" 2>/dev/null || true
    wait "${pids[@]}" 2>/dev/null || true
  fi
  exit "$status"
}
trap finish EXIT

# Without PyPI all is built but this one.
! grep -qw rex_drive "$place/typed" || need rex_drive
[[ -d $clone ]] || make_clone
cd "$clone"
# shellcheck source=/dev/null
. "$place/typed"
