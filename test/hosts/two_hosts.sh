#!/usr/bin/env bash
# Two hosts on one machine: MP, ECP and terminal in one network namespace, world and driver in another one whose clocks show
# another time, and a network that loses one message in a hundred. The run must be the same as on one host.
# two_hosts.sh BIN
set -euo pipefail
bin=$(realpath "$1")
skip() {
  echo "SKIPPED: $*"
  exit 77
}
fail() {
  echo "FAILED: $*" >&2
  exit 1
}
[[ $EUID -eq 0 ]] || skip "only root can make network namespaces"
command -v ip >/dev/null || skip "iproute2 is not installed"

desk=mrroc-desk-$$ robot=mrroc-robot-$$
place=$(mktemp -d "${TMPDIR:-/tmp}/mrroc-hosts.XXXXXX")
clean() {
  ip netns del "$desk" 2>/dev/null || true
  ip netns del "$robot" 2>/dev/null || true
  rm -rf "$place"
}
trap clean EXIT
ip netns add "$desk" 2>/dev/null || skip "network namespaces are not allowed here"
ip netns add "$robot"
ip netns exec "$robot" true 2>/dev/null || skip "nothing can be run in a network namespace here"
ip link add name "d$$" netns "$desk" type veth peer name "r$$" netns "$robot" || skip "there are no virtual network cards here"
number=1
for side in "$desk d$$" "$robot r$$"; do
  read -r host card <<<"$side"
  ip -n "$host" addr add "10.199.0.$number/24" dev "$card"
  ip -n "$host" link set "$card" up
  ip -n "$host" link set lo up
  ip -n "$host" route add 224.0.0.0/4 dev "$card"
  number=$((number + 1))
done

over_there="ip netns exec $robot" clocks=two
if unshare --time --monotonic 12345 --boottime 12345 --fork true 2>/dev/null; then
  over_there+=" unshare --time --monotonic 12345 --boottime 12345 --kill-child --fork"
else
  clocks=one
fi
# What ssh does with its words: a shell reads them as one line, in a folder of its own.
printf '#!/bin/sh\nshift\ncd /\nexec %s /bin/sh -c "$*"\n' "$over_there" >"$place/ssh"
chmod +x "$place/ssh"
cd "$place"
"$bin/press" --processes one --run-dir "$place/alone" >/dev/null
{
  printf 'time.n_s = 10\n[robots]\norder = ["arm1"]\n[robots.arm1]\nmodel = "irb6_postument"\nsynchro = "known_pose"\n'
  printf '[link]\nloss = 0.01\n[hosts.robot]\nprocesses = ["simulator", "edp-arm1"]\n'
} >"$place/press.toml"
ip netns exec "$desk" "$bin/press" --config "$place/press.toml" --host "robot=$place/ssh robot" --run-dir "one run" --session "two-hosts-$$" &
task=$!
seen=false
for _ in $(seq 200); do
  kill -0 $task 2>/dev/null || break
  if ip netns exec "$desk" "$bin/ui_cli" --session "two-hosts-$$" status >"$place/status" 2>/dev/null; then
    seen=true
    break
  fi
  sleep 0.2
done
wait $task || fail "the task ended with $?"
$seen || fail "the terminal has not seen the task"
grep -q edp-arm1 "$place/status" || fail "the terminal does not list the driver"

hash_of() { sed -n 's/.*"log_hash": "\(.*\)".*/\1/p' "$1/summary.json"; }
[[ -n $(hash_of "$place/one run") ]] || fail "no fingerprint"
[[ $(hash_of "$place/one run") == $(hash_of "$place/alone") ]] || fail "the run differs from that on one host"
[[ $clocks == two ]] || skip "time namespaces are not allowed here: the run is the same, but both hosts had one clock"
