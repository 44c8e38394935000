#!/bin/bash
# The full-screen view in a real terminal. Usage: terminal_test.sh FOLDER_OF_PROGRAMS
# Skipped (77) without tmux, or where messages between processes are impossible.
set -u
bin=$1
if [ -z "${MRROC_IN_OWN_NETWORK:-}" ]; then
  command -v tmux >/dev/null || { echo "skipped: there is no tmux"; exit 77; }
  # A network of its own: the test needs multicast, and disturbs nobody.
  own=-n # root in a root of another file system may make no namespace of users
  [ "$(id -u)" = 0 ] || own=-rn
  unshare $own true 2>/dev/null || { echo "skipped: no network namespaces"; exit 77; }
  MRROC_IN_OWN_NETWORK=1 exec unshare $own "$0" "$bin"
fi
ip link set lo up && ip route add 224.0.0.0/4 dev lo || { echo "skipped: cannot set up a network"; exit 77; }

home=$(mktemp -d)
export XDG_RUNTIME_DIR=$home TMUX_TMPDIR=$home LC_ALL=C.UTF-8
unset TMUX
"$bin/ui_cli_fake_task" demo &
task=$!
cleanup() {
  tmux kill-server 2>/dev/null
  kill "$task" 2>/dev/null
  rm -rf "$home"
}
trap cleanup EXIT

fail() {
  echo "FAILED: $1; the screen was:"
  tmux capture-pane -p
  exit 1
}
# Waits until a pattern is on the screen.
see() {
  for _ in $(seq 100); do
    if tmux capture-pane -p 2>/dev/null | grep -qE -- "$1"; then return 0; fi
    sleep 0.1
  done
  fail "'$1' does not appear"
}
press() { tmux send-keys "$1"; }
status_is() {
  "$@" </dev/null >"$home/out" 2>"$home/err"
  echo $?
}

for _ in $(seq 50); do [ -e "$home/mrroc-$(id -u)/demo.json" ] && break; sleep 0.1; done

tmux -f /dev/null new-session -d -x 80 -y 24 "cd $home; bash --norc"
tmux send-keys "PS1='prompt '; clear; TERM=xterm-256color $bin/ui_cli; echo \"left with \$?\"" Enter
see 'session demo +waiting for start'
see 'arm1 .*paper_surface'
see 'vsp arm1 +running'
see '^ s start .* q leave'
press s
see 'start accepted'
see '^ drawing .* running'
see 'mp: operator: start'
see '[▁▂▃▄▅▆▇█]+ +(2|0(..2)? N)$'
press p
see '^ drawing .* paused'
press p
see 'pause refused: the task is paused'
press r
see '^ drawing .* running'
tmux resize-window -x 130 -y 40
see 'F_x \[N\] F_y \[N\]'
tmux resize-window -x 60 -y 12
see '^ drawing   session demo +running'
see '^ s start'
tmux resize-window -x 80 -y 24
see 'e E-STOP  \? help  q leave$'
tmux resize-window -x 60 -y 15
see 'e E-STOP \? q$'
see '^ AGENT'
tmux resize-window -x 80 -y 24
see 'q leave$'
press c
see '^ F_x'
press c; press c
see '^ x m .*|^ x  .*'
press m
see 'arms are moved by hand in the task .manual.'
press '?'
see 'Any key goes back'
press '?'
see 'PROCESS'
press q
see 'left with 0'
see '^prompt'

# A terminal without colours and without UTF-8.
tmux send-keys "clear; LC_ALL=C TERM=vt100 $bin/ui_cli watch; echo \"left with \$?\"" Enter
see '^ drawing   session demo +running'
see '[_.=+*%#-]+ +(2|0(..2)? N)$'
press C-c
see 'left with 0'

# Curses itself leaks when it refuses a terminal, which only a sanitizer would notice.
tmux send-keys "clear; ASAN_OPTIONS=detect_leaks=0 TERM=no-such-type $bin/ui_cli; echo \"left with \$?\"" Enter
see "error: bad_usage: the terminal type 'no-such-type' is not known; set TERM"
see 'left with 2'

[ "$(status_is "$bin/ui_cli")" = 2 ] || fail "no terminal must be refused with 2"
grep -q '^error: bad_usage: the full-screen view needs a terminal' "$home/err" || fail "wrong reason: $(cat "$home/err")"

tmux send-keys "clear; $bin/ui_cli; echo \"left with \$?\"" Enter
see '^ drawing   session demo +running'
press x
see 'stop the task for good\? y/n'
press n
see 'not stopped'
[ "$(status_is "$bin/ui_cli" resume)" = 1 ] || fail "a running task must refuse resume with 1"
grep -q '^error: illegal_in_state: resume refused: the task is running' "$home/err" || fail "wrong reason: $(cat "$home/err")"
press e
see 'session demo +ended'
press q
see 'left with 0'
wait "$task" || fail "the task ended with $?"
[ "$(status_is "$bin/ui_cli" status)" = 2 ] || fail "no task must be refused with 2"

# Arms moved by hand: motors may be jogged before homing, joints may not.
"$bin/manual" --speed 2 --session hand --run-dir "$home/hand" >"$home/manual.out" 2>"$home/manual.err" &
task=$!
for _ in $(seq 100); do grep -q 'wait for an order' "$home/manual.out" && break; sleep 0.1; done
tmux send-keys "clear; $bin/ui_cli; echo \"left with \$?\"" Enter
see '^ manual   session hand +running'
press m
see '^ MANUAL +1 arm1 +2 arm2'
see '> axis 1 .* rad'
press Right
see 'jog arm1 failed: arm1 does not know its position'
press c; press c; press c
see 'step 5 rad'
press Down; press Right
see 'jog arm1 motors 0 5 0 0 0 0 speed 0.15: done'
press 2; press g
see 'jaws of arm2 to \[m\]: _'
press x; press Escape
see '> axis 2'
tmux resize-window -x 60 -y 15
see '> axis 2'
see '^e E-STOP'
tmux resize-window -x 80 -y 24
press e
see 'session hand +EMERGENCY STOP, ended'
press m; press q
see 'left with 0'
wait "$task"
[ $? = 1 ] || fail "after an emergency stop the status is 1"
grep -q '^error: emergency_stop: ' "$home/manual.err" || fail "wrong reason: $(cat "$home/manual.err")"
echo passed
