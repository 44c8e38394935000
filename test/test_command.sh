# shellcheck shell=bash disable=SC2154  # its variables are those of ./run, which sources it
# The command `./run test`: tests, with sanitizers too, and checks of the sources.

passed=0 failed=0

# Leaves out the lines of tests that passed; a terminal sees the count instead.
only_failures() {
  local line start='^ +Start +[0-9]+: ' pass='^ *([0-9]+/[0-9]+) Test +#.* Passed '
  while IFS= read -r line; do
    if [[ $line =~ $pass ]]; then
      [[ ! -t 1 ]] || printf '\r%s ' "${BASH_REMATCH[1]}"
    elif [[ ! $line =~ $start ]]; then
      printf '%s\n' "$line"
    fi
  done
}

# skip_reasons PRESET: a line for every reason, with the tests that were skipped for it
skip_reasons() {
  awk -f "$root/cmake/skip_reasons.awk" "$build/test-$1.log" "$build/$1/Testing/Temporary/LastTest.log" >&2
}

# failure_reasons PRESET: the tests that failed once more, each with what it says first
failure_reasons() { awk -f "$root/cmake/failure_reasons.awk" "$build/test-$1.log" >&2; }

# run_tests PRESET [ctest options]: all output in build/test-PRESET.log, that of failures here
run_tests() {
  local preset=$1 log=$build/test-$1.log start=$SECONDS status=0 bad all skipped
  shift
  (cd "$root" && ctest --preset "$preset" "$@") 2>&1 | tee "$log" | only_failures || status=$?
  read -r bad all < <(sed -nE 's/.* ([0-9]+) tests failed out of ([0-9]+).*/\1 \2/p' "$log" | tail -n 1) || true
  bad=${bad:-1} all=${all:-1}
  ((status == 0)) || ((bad > 0)) || bad=1
  skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped ' "$log") || true
  passed=$((passed + all - bad - skipped)) failed=$((failed + bad))
  ((skipped == 0)) || skip_reasons "$preset"
  ((bad == 0)) || failure_reasons "$preset"
  say "$preset tests: $((all - bad - skipped)) passed, $bad failed, $skipped skipped ($((SECONDS - start)) s)"
}

# check TEXT LOG COMMAND...: a phase that counts as one test
check() {
  if phase "$@"; then passed=$((passed + 1)); else failed=$((failed + 1)); fi
}

check_format() {
  git -C "$root" ls-files -z '*.cpp' '*.hpp' | (cd "$root" && xargs -0 clang-format --dry-run -Werror)
}

check_shell() { (cd "$root" && git ls-files -z run .ci/run '*.sh' | xargs -0 shellcheck --external-sources --severity=warning); }

test_format() {
  need_packages "${check_packages[@]}"
  local before=$passed
  check "clang-format" format check_format
  check "shellcheck" shellcheck check_shell
  say "checks of the sources: $((passed - before)) passed, $((2 - passed + before)) failed, 0 skipped"
}

# tidy_files SINCE SHARE: of the files that the build knows, those that differ from a commit, or for a header that does one
# that includes it; and part K of N of all. Neither is named: all
tidy_files() {
  local list=$build/tidy-known.txt name found step
  sed -n 's/^ *"file": "\(.*\)",*$/\1/p' "$build/dev/compile_commands.json" | grep -v "^$build/" | sort -u >"$list"
  [[ -n $1$2 ]] || cat "$list"
  [[ -z $2 ]] || awk -v k="${2%/*}" -v n="${2#*/}" 'NR % n == k % n' "$list"
  [[ -n $1 ]] || return 0
  while IFS= read -r name; do
    case $name in
      *.cpp) grep -xF "$root/$name" "$list" ;;
      *)
        # From header to header, until a source includes one.
        for ((step = 0; step < 5; ++step)); do
          found=$(git -C "$root" grep -lF "#include \"$name\"" -- '*.cpp' | sed "s|^|$root/|" | grep -xFf "$list" | sed -n 1p) || true
          [[ -z $found ]] || break
          name=$(git -C "$root" grep -lF "#include \"$name\"" -- '*.hpp' | sed -n 1p) || true
          [[ -n $name ]] || break
        done
        [[ -z $found ]] || printf '%s\n' "$found"
        ;;
    esac || true # one that no build knows
  done < <(git -C "$root" diff --name-only --diff-filter=d "$1" -- '*.cpp' '*.hpp')
}

# changed_lines SINCE: for clang-tidy, which then speaks of nothing else; of too many only the files
changed_lines() {
  git -C "$root" diff --no-color --no-ext-diff --src-prefix=a/ --dst-prefix=b/ -U0 --diff-filter=d "$1" -- '*.cpp' '*.hpp' | awk '
    function close_file() {
      if (name == "") return
      names = names (names ? "," : "") "{\"name\":\"" name "\"}"
      files = files (files ? "," : "") "{\"name\":\"" name "\"" (lines ? ",\"lines\":[" lines "]" : "") "}"
    }
    /^\+\+\+ b\// { close_file(); name = substr($2, 3); lines = "" }
    /^@@/ {
      split(substr($3, 2), at, ","); n = at[2] == "" ? 1 : at[2]
      if (n > 0) lines = lines (lines ? "," : "") "[" at[1] "," at[1] + n - 1 "]"
    }
    END { close_file(); print "[" (length(files) > 120000 ? names : files) "]" }'
}

# tidy_one DEADLINE FILE: says what is wrong with it, and writes down that it was looked at
tidy_one() {
  local said done=ok
  if (($1 > 0 && EPOCHSECONDS > $1)); then
    done=skipped
  elif ! said=$(clang-tidy --quiet -p "$build/dev" ${lines:+"--line-filter=$lines"} "$2" 2>/dev/null); then
    done=failed
    printf '%s\n' "$said"
    say "FAILED: clang-tidy: $2"
  fi
  printf '%s %s\n' "$done" "$2" >>"$build/tidy-done.txt"
}

# test_tidy SINCE SHARE MINUTES: every file counts as a test
test_tidy() {
  local files=$build/tidy-files.txt log=$build/tidy.log start=$SECONDS deadline=0 all good skipped bad
  [[ -z $3 ]] || deadline=$((EPOCHSECONDS + 60 * $3))
  need_packages "${packages[@]}" "${check_packages[@]}"
  compile dev mrroc_generated
  tidy_files "$1" "$2" | sort -u | shuf >"$files" # so that others are left when the time is over
  [[ -s $files ]] || say "no file is concerned"
  : >"$build/tidy-done.txt"
  local lines=''
  [[ -z $1 || -n $2 ]] || lines=$(changed_lines "$1")
  export -f tidy_one say
  export build lines
  xargs -r -a "$files" -d '\n' -P "$jobs" -n 1 bash -c 'tidy_one "$@"' bash "$deadline" >"$log" || true
  all=$(wc -l <"$files")
  good=$(grep -c '^ok ' "$build/tidy-done.txt") || true
  skipped=$(grep -c '^skipped ' "$build/tidy-done.txt") || true
  bad=$((all - good - skipped))
  if ((bad > 0)); then
    grep -E '(error|warning): ' "$log" | sort -u | sed -n 1,60p >&2
  fi
  ((skipped == 0)) || say "skipped: $skipped files: no time was left for them"
  passed=$((passed + good)) failed=$((failed + bad))
  say "clang-tidy: $good passed, $bad failed, $skipped skipped ($((SECONDS - start)) s)"
}

# test_sanitized PRESET [ctest options]: with threads what CMakePresets.json names for them
test_sanitized() {
  local targets=(programs tests)
  [[ $1 != tsan ]] || targets=(base_link_test mp_test mp_delay_test test_every_task)
  need_packages "${packages[@]}"
  compile "$1" "${targets[@]}"
  run_tests "$@"
}

# fuzz_one MINUTES NAME: says how it ended, and writes it down
fuzz_one() {
  local name=$2 folder=$root/test/fuzz found=$build/fuzz/found/$2 seen=$build/fuzz/seen/$2 log=$build/fuzz-$2.log
  local options=("-max_total_time=$((60 * $1))" -max_len=20000 -timeout=25 -rss_limit_mb=2048 "-artifact_prefix=$found/")
  mkdir -p "$found" "$seen"
  # In a new clone the shortest run begins the same each time, so that it speaks of a change; longer ones draw anew.
  (($1 > 1)) || options+=(-seed=1)
  [[ ! -e $folder/dictionary/$name.dict ]] || options+=("-dict=$folder/dictionary/$name.dict")
  if "$build/fuzz/bin/fuzz_$name" "${options[@]}" "$seen" "$folder/corpus/$name" >"$log" 2>&1; then
    say "fuzzing $name ... $SECONDS s"
    echo ok >>"$build/fuzz-done.txt"
  else
    say "fuzzing $name ... failed after $SECONDS s"$'\n'"$(tail -n 30 "$log")"
  fi
}

# test_fuzz MINUTES: every target of test/fuzz counts as a test. New inputs are kept for the next time.
test_fuzz() {
  local folder=$root/test/fuzz start=$SECONDS all good
  need_packages "${packages[@]}" "${fuzz_packages[@]}"
  compile fuzz fuzz
  : >"$build/fuzz-done.txt"
  export -f fuzz_one say
  export root build
  find "$folder/corpus" -mindepth 1 -maxdepth 1 -type d -printf '%f\n' | sort |
    xargs -P "$jobs" -I NAME bash -c 'fuzz_one "$@"' bash "$1" NAME
  all=$(find "$folder/corpus" -mindepth 1 -maxdepth 1 -type d | wc -l)
  good=$(wc -l <"$build/fuzz-done.txt")
  passed=$((passed + good)) failed=$((failed + all - good))
  say "fuzz targets: $good passed, $((all - good)) failed, 0 skipped ($((SECONDS - start)) s)"
}

test_release() {
  prepare programs tests
  if (($#)) && ! (cd "$root" && ctest --preset release -N "$@" | grep '^  Test ' >/dev/null); then
    fail 2 bad_usage "no test has '$2' in its name; all names: ctest --test-dir build/release -N"
  fi
  run_tests release "$@"
}

run_test_command() {
  local what=() filter=() page=false campaign=false since='' share='' minutes=''
  while (($#)); do
    case $1 in
      --all) what+=(release asan tsan fuzz format tidy) page=true campaign=true ;;
      --page) page=true ;;
      --campaign) campaign=true ;;
      --asan | --tsan | --fuzz | --format | --tidy) what+=("${1#--}") ;;
      -R | --since | --share | --minutes)
        [[ -n ${2:-} ]] || fail 2 bad_usage "$1 wants a value; look at ./run test --help"
        case $1 in -R) filter=(-R "$2") ;; --since) since=$2 ;; --share) share=$2 ;; --minutes) minutes=$2 ;; esac
        shift
        ;;
      *) fail 2 bad_usage "test does not know '$1'; look at ./run test --help" ;;
    esac
    shift
  done
  [[ -z $since ]] || git -C "$root" rev-parse --quiet --verify "$since^{commit}" >/dev/null ||
    fail 2 bad_usage "--since: there is no commit '$since'"
  [[ -z $share ]] || { [[ $share =~ ^[0-9]+/[0-9]+$ ]] && ((10#${share%/*} < 10#${share#*/})); } ||
    fail 2 bad_usage "--share: '$share' is not of the form K/N with K from 0 to N - 1"
  [[ -z $minutes || $minutes =~ ^[1-9][0-9]*$ ]] || fail 2 bad_usage "--minutes: '$minutes' is no number of minutes"
  [[ -z $since || " ${what[*]} " == *" tidy "* ]] || fail 2 bad_usage "--since is for --tidy; look at ./run test --help"
  [[ -z $share || " ${what[*]} " =~ " tidy "|" asan "|" tsan " ]] ||
    fail 2 bad_usage "--share is for --tidy, --asan and --tsan; look at ./run test --help"
  [[ -z $minutes || " ${what[*]} " =~ " tidy "|" fuzz " ]] ||
    fail 2 bad_usage "--minutes is for --tidy and --fuzz; look at ./run test --help"
  ((${#filter[@]} == 0)) || [[ ! " ${what[*]} " =~ " format "|" tidy "|" fuzz " ]] ||
    fail 2 bad_usage "-R is for tests; --format and --tidy look at sources, --fuzz makes inputs"
  if $page; then need_packages "${page_packages[@]}"; fi
  if $campaign; then need_packages "${campaign_packages[@]}"; fi
  ((${#what[@]})) || what=(release)
  local part
  for part in "${what[@]}"; do
    case $part in
      release) test_release "${filter[@]}" ;;
      asan | tsan) test_sanitized "$part" "${filter[@]}" ${share:+-I "$((10#${share%/*} + 1)),,$((10#${share#*/}))"} ;;
      fuzz) test_fuzz "${minutes:-1}" ;;
      format) test_format ;;
      tidy) test_tidy "$since" "$share" "$minutes" ;;
    esac
  done
  printf '%d passed, %d failed\n' "$passed" "$failed"
  ((failed == 0)) || fail 1 tests_failed "$failed of $((passed + failed)) failed; the reasons are above and in build/*.log"
}
