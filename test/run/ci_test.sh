#!/usr/bin/env bash
# The script .ci/run in a made-up clone, with a made-up ./run. Usage: ci_test.sh ROOT NAME
set -euo pipefail
command -v git >/dev/null || { echo 'skipped: there is no git'; exit 77; }

clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
mkdir -p "$clone/.ci" "$clone/test/bare"
cp "$1/.ci/run" "$clone/.ci/run"
cd "$clone"
unset MRROC_CI_PARTS
export MRROC_CI_MEMORY=$clone/memory PATH=$clone/stubs:$PATH
mkdir stubs memory
printf '#!/bin/sh\n' >stubs/mmdebstrap

# Every part has 3 tests, 1 of which is skipped; a file fail-WORD says what the line with that word ends with.
cat >run <<'STUB'
#!/usr/bin/env bash
echo "./run $*" >>calls
for file in fail-*; do
  [[ -e $file && " $* " == *" --${file#fail-} "* ]] || continue
  cat "$file"
  exit 1
done
if [[ -e slow && "$*" == *--asan* ]]; then cat slow && sleep 40; fi
if [[ -e killed && "$*" == *--asan* ]]; then kill -9 $$; fi
if [[ -e all-skipped && "$*" == *--page* ]]; then echo 'made-up tests: 0 passed, 0 failed, 1 skipped (1 s)' && exit; fi
if [[ -e no-time && "$*" == *--since* ]]; then echo 'skipped: 3 files: no time was left for them'; fi
if [[ -e no-time-for-the-share && "$*" == *--share* ]]; then echo 'skipped: 3 files: no time was left for them'; fi
echo 'skipped: Page.Shows: there is no Chromium'
echo "made-up tests: 2 passed, 0 failed, 1 skipped (1 s)"
STUB
cat >test/bare/bare.sh <<'STUB'
#!/usr/bin/env bash
echo "bare" >>calls
if [[ -e broken ]]; then echo 'FAILED: ./run drawing'; exit 1; fi
if [[ -e no-mirror ]]; then echo 'skipped: mmdebstrap made no root'; exit 77; fi
echo '  release tests: 10 passed, 0 failed, 0 skipped (1 s)'
echo 'bare machine: 3 passed, 0 failed, 0 skipped'
echo 'fresh_clone_s 99'
echo 'bare_machine_ok 1'
STUB
chmod +x run stubs/mmdebstrap test/bare/bare.sh
git init -q . && git -c user.name=a -c user.email=a@b commit -q --allow-empty -m made-up

fail() {
  printf 'FAILED: %s\n--- it said:\n%s\n' "$1" "$said" >&2
  exit 1
}
says() { [[ $said == *"$1"* ]] || fail "'$1' is missing"; }
says_not() { [[ $said != *"$1"* ]] || fail "'$1' is too much"; }
# ci STATUS: runs it
ci() {
  local status=0
  rm -f calls
  said=$(.ci/run 2>&1) || status=$?
  ((status == $1)) || fail "status $status, not $1"
}

all_parts_run_and_their_tests_are_counted() {
  ci 0
  [[ $(wc -l <calls) == 8 ]] || fail "$(cat calls)"
  says 'bare_machine_ok 1'
  says 'fresh_clone_s 99'
  says 'skipped: Page.Shows: there is no Chromium'
  [[ $(tail -n 1 <<<"$said") == '27 passed, 0 failed, 7 skipped' ]] || fail 'the last line'
  [[ $(cat memory/landed) == "$(git rev-parse HEAD)" ]] || fail 'the commit is not kept'
}

a_part_that_fails_decides_and_the_others_run() {
  local part
  for part in asan tsan fuzz format tidy page; do
    echo 'made-up tests: 1 passed, 2 failed, 0 skipped' >"fail-$part"
    ci 1
    says 'FAILED'
    [[ $(wc -l <calls) == 8 ]] || fail "$(cat calls)"
    [[ ! -e memory/landed ]] || fail 'it has not landed'
    rm "fail-$part"
  done
  touch broken
  ci 1
  says 'FAILED'
  rm broken
  : >fail-asan # it says nothing
  ci 1
  [[ $(tail -n 1 <<<"$said") == *' 1 failed, '* ]] || fail 'it is not counted'
}

what_cannot_run_here_fails_nothing_and_comes_first_the_next_time() {
  touch no-mirror
  echo "error: install_failed: Debian's servers were not reached; look at the network" >fail-page
  ci 0
  says 'NOT RUN'
  grep -qx './run test' calls || fail 'the tests did not run at all'
  rm no-mirror fail-page
  ci 0
  [[ $(sed -n '1p;2p' calls | tr '\n' ' ') == 'bare ./run test --page '* ]] || fail "$(cat calls)"
  says_not 'NOT RUN'
}

the_bare_machine_comes_first_whatever_was_left_out() {
  printf 'tsan\nshare\n' >memory/left_out
  ci 0
  [[ $(head -n 3 calls | cut -d ' ' -f 1-3 | tr '\n' ' ') == 'bare ./run test --tsan ./run test --tidy ' ]] || fail "$(cat calls)"
}

what_has_not_begun_in_time_is_told_and_fails_nothing() {
  MRROC_CI_LAST_BEGIN=-1 ci 0
  [[ ! -e calls ]] || fail "$(cat calls)"
  says 'NOT RUN'
  says 'it had not begun after'
  [[ $(wc -l <memory/left_out) == 8 ]] || fail 'they are not kept'
  [[ ! -e memory/landed ]] || fail 'what nobody looked at has landed'
}

checks_look_at_what_differs_from_the_commit_that_passed_last_and_at_shares_by_turns() {
  local before
  ci 0
  before=$(git rev-parse HEAD)
  grep -q -- '--tidy --share 1/24' calls || fail "$(cat calls)"
  grep -q -- '--asan --share 1/3' calls || fail "$(cat calls)"
  git -c user.name=a -c user.email=a@b commit -q --allow-empty -m next
  ci 0
  grep -q -- "--since $before" calls || fail "$(cat calls)"
  grep -q -- '--share 2/24' calls || fail "$(cat calls)"
  grep -q -- '--asan --share 2/3' calls || fail "$(cat calls)"
  # Files for which no time was left belong to the next run's.
  before=$(git rev-parse HEAD)
  git -c user.name=a -c user.email=a@b commit -q --allow-empty -m third
  touch no-time
  ci 0
  grep -q -- '--share 3/24' calls || fail "$(cat calls)"
  ci 0
  grep -q -- "--since $before" calls || fail "$(cat calls)"
  # A share, too.
  rm no-time
  touch no-time-for-the-share
  ci 0
  ci 0
  grep -q -- '--share 5/24' calls || fail "$(cat calls)"
}

a_third_whose_tests_failed_has_its_turn_once_more_whatever_the_share_of_the_checks() {
  echo 'made-up tests: 1 passed, 2 failed, 0 skipped' >fail-asan
  ci 1
  rm fail-asan
  ci 0
  grep -q -- '--asan --share 1/3' calls || fail "$(cat calls)"
  touch no-time-for-the-share
  ci 0
  ci 0
  grep -q -- '--asan --share 0/3' calls || fail "$(cat calls)"
}

a_part_that_is_not_through_in_time_is_ended_and_what_failed_in_it_decides() {
  touch slow
  export MRROC_CI_PARTS="format asan changed" MRROC_CI_LAST_END=15
  ci 0
  says 'it was ended 0 minutes after the beginning of the whole'
  grep -qx asan memory/left_out || fail 'it does not come first the next time'
  [[ ! -e memory/landed ]] || fail 'what nobody looked at has landed'
  echo '  7/9 Test #7: Links.Hear ...***Failed  0.1 sec' >slow
  rm memory/left_out
  ci 1
  says 'FAILED'
}

a_part_that_had_all_the_time_or_was_killed_by_others_has_failed() {
  touch slow
  MRROC_CI_PARTS="asan format" MRROC_CI_LAST_END=15 ci 1
  says 'FAILED'
  says 'it was ended'
  rm slow
  touch killed
  MRROC_CI_PARTS="format asan" ci 1
  says 'FAILED'
}

a_part_whose_tests_were_all_skipped_has_not_run() {
  touch all-skipped
  MRROC_CI_PARTS="format page" ci 0
  says 'NOT RUN'
  grep -qx page memory/left_out || fail 'it does not come first the next time'
}

"$2"
