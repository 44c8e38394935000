#!/usr/bin/env bash
# The project on a bare Debian: what the README tells a newcomer to type, in a root that holds apt and nothing else.
# Usage: bare.sh [--cold] [--tests] [--keep] [CONTRACT...]; it needs root, a mirror of Debian and some 6 GB below build/bare.
# Exit status: 0 all contracts hold; 1 one does not; 77 no bare root could be made here, for the reason it says.
set -euo pipefail
shopt -s inherit_errexit
export LC_ALL=C.UTF-8

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
place=$top/build/bare
pristine=$place/pristine
suite=bookworm
bare_path=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin
contracts=(the_commands_of_the_readme_work
  a_user_who_may_not_install_is_told_what_to_type
  without_a_network_it_is_said)

usage() {
  cat <<TEXT
Usage: test/bare/bare.sh [--cold] [--tests] [--keep] [CONTRACT...]

  --cold   without the compiler's cache of this machine
  --tests  all that the README begins with, the tests as well, not only its first command
  --keep   the roots stay in build/bare, to look at
Contracts, by default all of them:
$(printf '  %s\n' "${contracts[@]}")
TEXT
}

say() { printf '%s\n' "$*"; }
# not_here WHY: no fault of the project
not_here() {
  say "skipped: $1"
  exit 77
}
# broken WHAT [FILE]: a contract does not hold
broken() {
  say "FAILED: $1"
  [[ -z ${2:-} ]] || tail -n 90 "$2"
  exit 1
}

# --- the root --------------------------------------------------------------------------------------------

# Debian's own archives among those that this machine uses.
mirrors() {
  apt-get indextargets --format '$(ORIGIN)|deb $(REPO_URI) $(RELEASE) $(COMPONENT)' 'Created-By: Packages' |
    sed -n 's/^Debian|//p' | sort -u
}

# How this machine reaches them.
apt_settings() { apt-config dump | grep -E '^Acquire::(https?::|Retries|ForceIPv[46]|Check-Valid-Until)' || true; }

# How this machine reaches PyPI, as lines of pip.conf; `pip config list` gives what files and the environment say.
pip_settings() {
  echo '[global]'
  { /usr/bin/python3 -m pip config list 2>/dev/null || true; } |
    sed -nE "s/^(global|install|:env:)\.(index-url|extra-index-url|trusted-host|proxy|cert)='(.*)'$/\2 = \3/p" | sort -u -t = -k 1,1
}

# give_pip ROOT: those settings; the certificates that they name go along
give_pip() {
  local certificates
  pip_settings >"$1/etc/pip.conf"
  certificates=$(sed -n 's/^cert = //p' "$1/etc/pip.conf")
  [[ -r $certificates ]] || return 0
  cp "$certificates" "$1/etc/pip.crt"
  sed -i 's|^cert = .*|cert = /etc/pip.crt|' "$1/etc/pip.conf"
}

# The root that all others are copies of; it is made once for the archives that this machine uses.
make_pristine() {
  command -v mmdebstrap >/dev/null || not_here "mmdebstrap is not installed"
  local sources
  sources=$(mirrors)
  [[ -n $sources ]] || not_here "apt knows no archive of Debian; try apt-get update"
  mkdir -p "$place"
  [[ ! -d $pristine || $(cat "$place/sources.list" 2>/dev/null) != "$sources" ]] || return 0
  rm -rf "$pristine" "$pristine.new" # of other archives, or of one that was ended
  apt_settings >"$place/apt.conf"
  mmdebstrap --variant=apt --aptopt="$place/apt.conf" "$suite" "$pristine.new" <<<"$sources" >"$place/mmdebstrap.log" 2>&1 || {
    tail -n 5 "$place/mmdebstrap.log"
    rm -rf "$pristine.new"
    not_here "mmdebstrap made no root; build/bare/mmdebstrap.log tells why"
  }
  mv "$pristine.new" "$pristine"
  printf '%s\n' "$sources" >"$place/sources.list"
}

# new_root NAME HOME: a fresh copy with a clone of HEAD in HOME/mrroc; prints its folder
new_root() {
  local root=$place/$1
  rm -rf "$root"
  cp -a "$pristine" "$root"
  apt_settings >"$root/etc/apt/apt.conf.d/90mirror"
  give_pip "$root"
  cp /etc/resolv.conf "$root/etc/resolv.conf"
  mount --bind "$root" "$root" # network namespaces want / to be a mount
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  mount -t tmpfs tmpfs "$root/dev/shm"
  mkdir -p "$root$2"
  git clone --quiet --no-hardlinks "$top" "$root$2/mrroc"
  say "$root"
}

# drop ROOT
drop() {
  umount --recursive --lazy "$1"
  $keep || rm -rf --one-file-system "$1"
}

# inside ROOT LINE: types a line in root's home, with an environment as bare as the root
inside() { chroot "$1" /usr/bin/env -i HOME=/root PATH=$bare_path /bin/bash -c "cd && $2" </dev/null; }

# --- contracts -------------------------------------------------------------------------------------------

# The first block of the README, without its comments.
commands_of_the_readme() {
  awk '/^```/ { if (inside) exit; inside = 1; next } inside { sub(/ *#.*/, ""); print }' "$top/README.md"
}

# stamped FILE: copies lines to a file, each with the time at which it came; tests that fail are told at once
stamped() {
  local line
  while IFS= read -r line; do
    printf '%s %s\n' "$EPOCHREALTIME" "$line" >&3
    [[ $line != *'***'[FTEN]* ]] || say "$line"
  done 3>"$1"
}

the_commands_of_the_readme_work() {
  local root command begun log n=0
  root=$(new_root readme /root)
  if [[ -n $cache ]]; then
    mkdir -p "$root/root/.cache/ccache"
    mount --bind "$cache" "$root/root/.cache/ccache"
  fi
  while IFS= read -r command; do
    n=$((n + 1))
    log=$place/readme-$n.log
    begun=$EPOCHREALTIME
    inside "$root" "cd mrroc && $command" 2>&1 | stamped "$log" || {
      ! tail -n 1 "$log" | grep -q "error: install_failed: Debian's servers" || not_here "$command: Debian's servers were not reached"
      broken "$command" "$log"
    }
    awk -v begun="$begun" -v command="$command" '{ last = $1 } END { printf "%s: %.0f s\n", command, last - begun }' "$log"
    # What it spent its time with, and when the first arm moved.
    sed -nE -e 's/^[^ ]+ ((installing|configuring) .*[0-9]+ s)$/  \1/p' \
      -e 's/^[^ ]+ +[0-9]+ % \(.* of ([0-9]+ steps)\) \.\.\. ([0-9]+ s)$/  building: \1, \2/p' "$log"
    awk -v begun="$begun" -v cache="${cache:+with what the compiler has in its cache}" '
      / m = 1 / { printf "fresh_clone_s %.0f %s\n", $1 - begun, cache; exit }' "$log"
    sed -nE 's/^[^ ]+ (.*PyPI did not give it .*|skipped: .*|.*: [0-9]+ passed, [0-9]+ failed, .*)$/  \1/p' "$log"
    $tests || break
  done < <(commands_of_the_readme)
  ((n > 0)) || broken "the README begins with no commands"
  drop "$root"
}

a_user_who_may_not_install_is_told_what_to_type() {
  local root status=0 said line
  root=$(new_root user /home/user)
  echo 'user:x:1000:1000::/home/user:/bin/bash' >>"$root/etc/passwd"
  echo 'user:x:1000:' >>"$root/etc/group"
  chown -R 1000:1000 "$root/home/user"
  said=$place/user.log
  chroot --userspec=1000:1000 "$root" /usr/bin/env -i HOME=/home/user PATH=/usr/bin:/bin \
    /bin/bash -c 'cd ~/mrroc && ./run drawing' >"$said" 2>&1 </dev/null || status=$?
  ((status == 2)) || broken "status $status, not 2" "$said"
  [[ $(tail -n 1 "$said") == 'error: missing_packages: '* ]] || broken 'the last line names no missing packages' "$said"
  # The line is typed, but for the minutes that the packages would take.
  line=$(sed -nE "s/.*type: su - -c '(.*)'$/\1/p" "$said")
  [[ $line == *' install '* ]] || broken 'it has no line to type' "$said"
  inside "$root" "${line/ install / --dry-run install }" >"$place/typed.log" 2>&1 || {
    ! grep -qE 'Failed to fetch|Temporary failure' "$place/typed.log" || not_here "Debian's servers were not reached"
    broken "root typed: $line" "$place/typed.log"
  }
  drop "$root"
}

without_a_network_it_is_said() {
  local root status=0 said=$place/network.log
  root=$(new_root network /root)
  (export -f inside && export bare_path && unshare --net bash -c 'inside "$@"' bash "$root" 'cd mrroc && ./run drawing') >"$said" 2>&1 ||
    status=$?
  ((status == 1)) || broken "status $status, not 1" "$said"
  [[ $(tail -n 1 "$said") == 'error: install_failed: '*network* ]] || broken 'the last line names no network' "$said"
  drop "$root"
}

# --- all of it -------------------------------------------------------------------------------------------

cache="" keep=false cold=false tests=false chosen=()
for word in "$@"; do
  case $word in
    --cold) cold=true ;;
    --keep) keep=true ;;
    --tests) tests=true ;;
    --help | -h) usage && exit ;;
    *)
      [[ " ${contracts[*]} " == *" $word "* ]] || { usage >&2 && exit 2; }
      chosen+=("$word")
      ;;
  esac
done
((${#chosen[@]})) || chosen=("${contracts[@]}")
$cold || cache=$(ccache --get-config cache_dir 2>/dev/null) || cache=
[[ -z $cache ]] || mkdir -p "$cache"

# What is mounted belongs to this run alone and goes with it, as do its processes.
[[ $EUID -eq 0 ]] || not_here "a bare root is made by root"
if [[ $$ != 1 ]]; then
  unshare --mount --pid --fork true 2>/dev/null || not_here "root may make no namespaces here"
  exec unshare --mount --pid --fork --kill-child --mount-proc "$0" "$@"
fi
make_pristine
for contract in "${chosen[@]}"; do
  begun=$SECONDS
  "$contract"
  say "ok: $contract ($((SECONDS - begun)) s)"
done
say "bare machine: ${#chosen[@]} passed, 0 failed, 0 skipped"
[[ ${#chosen[@]} -lt ${#contracts[@]} ]] || say "bare_machine_ok 1"
