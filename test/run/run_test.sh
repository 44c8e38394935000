#!/usr/bin/env bash
# The script ./run in a made-up clone, with a made-up cmake. Usage: run_test.sh ROOT NAME
set -euo pipefail

clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT
cp "$1/run" "$clone/run"
mkdir "$clone/cmake"
cp "$1"/cmake/*.awk "$clone/cmake/"
mkdir -p "$clone/tasks/sketch" "$clone/stubs" "$clone/test" "$clone/bench"
cp "$1/bench/main.cpp" "$clone/bench/"
cp "$1/test/test_command.sh" "$clone/test/"
touch "$clone/tasks/sketch/CMakeLists.txt" "$clone/CMakePresets.json"
cd "$clone"
export MRROC_SKIP_INSTALL=1 PATH=$clone/stubs:$PATH

# A build of eight steps, or of none when there is a file named built.
cat >stubs/cmake <<'STUB'
#!/usr/bin/env bash
mkdir -p build/release
touch build/release/build.ninja
[[ $1 == --build ]] || exit 0
echo '[0/2] Re-checking globbed directories...'
if [[ -e built ]]; then echo 'ninja: no work to do.'; exit 0; fi
if [[ -e broken ]]; then echo 'made-up compiler error'; exit 1; fi
echo '[1/2] Re-running CMake...'
for k in 1 2 3 4 5 6 7 8; do echo "[$k/8] step $k"; done
STUB
chmod +x stubs/cmake

fail() {
  printf 'FAILED: %s\n--- it said:\n%s\n' "$1" "$said" >&2
  exit 1
}
says() { [[ $said == *"$1"* ]] || fail "'$1' is missing"; }
says_not() { [[ $said != *"$1"* ]] || fail "'$1' is too much"; }

help_builds_nothing() {
  local command
  for command in build test bench clean; do
    said=$(./run "$command" --help 2>&1)
    says "Usage: ./run $command"
    [[ ! -e build ]] || fail "$command --help made a build folder"
  done
}

a_word_too_many_is_refused_before_anything_is_done() {
  mkdir build
  local command
  for command in build clean package; do
    said=$(./run "$command" first 2>&1) && fail "$command takes it"
    says "error: bad_usage: $command takes nothing more, but was given 'first'"
  done
  [[ -d build && -z $(ls build) ]] || fail 'something was done'
}

an_option_that_the_bench_does_not_have_is_refused_before_the_build() {
  local status=0
  said=$(./run bench cube --jsn figures.json 2>&1) || status=$?
  ((status == 2)) || fail "status $status"
  says "error: bad_usage: there is no option '--jsn'; did you mean --json?"
  [[ ! -e build ]] || fail 'it made a build folder'
}

a_group_that_the_bench_does_not_have_is_refused_before_the_build() {
  local words status
  for words in 'cubes' 'edp cubes --json' '--resume cubes' '--json=figures.json cubes' '--plots plots cubes'; do
    status=0
    # shellcheck disable=SC2086  # a list
    said=$(./run bench $words 2>&1) || status=$?
    ((status == 2)) || fail "$words: status $status"
    says 'known: edp servo trajectory stability '
    says "error: bad_usage: there is no group named 'cubes'; did you mean cube?"
    [[ ! -e build ]] || fail "$words made a build folder"
  done
}

all_groups_of_the_bench_and_names_of_its_files_are_taken() {
  touch built
  mkdir -p build/release/bin
  printf '#!/bin/sh\necho "measures $*"\n' >build/release/bin/bench
  chmod +x build/release/bin/bench
  # The words that the program's own help tells.
  local groups
  groups=$(sed -n '/line.option("group"/,/(default/p' bench/main.cpp | grep -v default | sed 's/^.*groups,//' | tr -d '",')
  # shellcheck disable=SC2086  # a list
  said=$(./run bench $groups --json cubes --plots cubes 2>&1)
  says 'measures edp servo trajectory stability vision drawing '
  says ' mutation --json cubes --plots cubes'
}

programs_are_told_how_they_were_called() {
  touch built tasks/sketch/main.cpp
  mkdir -p build/release/bin
  printf '#!/bin/sh\necho "type $MRROC_CALLED ui_cli, or $MRROC_CALLED sketch $1"\n' >build/release/bin/sketch
  chmod +x build/release/bin/sketch
  said=$(./run sketch --view 2>&1)
  says 'type ./run ui_cli, or ./run sketch --view'
  mkdir elsewhere
  said=$(cd elsewhere && ../run sketch 2>&1)
  says 'type ../run ui_cli'
}

a_signal_while_a_build_ends_well_starts_nothing() {
  touch built tasks/sketch/main.cpp
  mkdir -p build/release/bin
  printf '#!/bin/sh\ntouch begun\n' >build/release/bin/sketch
  chmod +x build/release/bin/sketch
  local signal when status expected
  for signal in INT TERM; do
    expected=130
    [[ $signal == INT ]] || expected=143
    # It comes to the whole group, as from a terminal, while CMake looks, configures or builds.
    for when in '--build' '-S'; do
      [[ $when == --build ]] || rm -f build/release/build.ninja
      sed "2i trap : $signal\n[[ \$1 != $when ]] || kill -$signal 0" "$clone/stubs/cmake" >"$clone/stubs/ending"
      mkdir -p ends && mv stubs/ending ends/cmake && chmod +x ends/cmake
      status=0
      said=$(PATH=$clone/ends:$PATH env --default-signal="$signal" setsid --wait ./run sketch 2>&1) || status=$?
      ((status == expected)) || fail "$signal at $when: status $status"
      [[ ! -e begun ]] || fail "$signal at $when: the program was started"
    done
  done
}

first_build_tells_how_long_and_counts() {
  said=$(./run build 2>&1)
  says 'for the first time'
  for line in '25 % (2 of 8 steps)' '50 % (4 of 8 steps)' '75 % (6 of 8 steps)'; do says "$line"; done
  says_not 'step 3'
}

nothing_to_build_is_no_news() {
  touch built
  ./run build 2>/dev/null
  said=$(./run build 2>&1)
  [[ -z $said ]] || fail 'it speaks'
}

a_build_that_fails_shows_why() {
  touch broken
  local status=0
  said=$(./run build 2>&1) || status=$?
  ((status == 1)) || fail "status $status"
  says 'made-up compiler error'
  says 'error: build_failed: '
}

waiting_for_another_build_is_said() {
  mkdir build
  touch built
  exec 8>build/.lock
  flock 8
  timeout 1 ./run build 2>said || true
  said=$(cat said)
  says 'another ./run is building in this clone; waiting'
}

a_folder_that_cannot_be_written_is_a_clear_error() {
  touch build # a file where the folder should be: also root cannot write there
  local status=0
  said=$(./run build 2>&1) || status=$?
  ((status == 3)) || fail "status $status"
  says 'error: cannot_write: '
}

skipped_tests_are_told_with_their_reasons() {
  touch built
  mkdir -p build/release/Testing/Temporary
  cat >stubs/ctest <<'STUB'
#!/usr/bin/env bash
cat >build/release/Testing/Temporary/LastTest.log <<'LOG'
1/3 Testing: Page.Shows
skipped: there is no Chromium
<end of output>
2/3 Testing: Arm.Moves
arm_test.cpp:12: Skipped
too long
<end of output>
3/3 Testing: Arm.Stands
skipped: not this test, which only says so
<end of output>
LOG
printf '%s\n' '1/3 Test #1: Page.Shows ....***Skipped   0.04 sec' '2/3 Test #2: Arm.Moves ....***Skipped   0.04 sec' \
  '3/3 Test #3: Arm.Stands ....   Passed    0.04 sec'
echo '100% tests passed, 0 tests failed out of 3'
printf 'The following tests did not run:\n\t  1 - Page.Shows (Skipped)\n\t  2 - Arm.Moves (Skipped)\n'
STUB
  chmod +x stubs/ctest
  said=$(./run test 2>&1)
  says 'skipped: Page.Shows: there is no Chromium'
  says 'skipped: Arm.Moves: too long'
  says_not 'skipped: Arm.Stands'
  says '1 passed, 0 failed'
}

# A made-up Debian: PACKAGES are known to it, of which the first is installed; apt-get says SAID and ends with STATUS.
debian() {
  unset MRROC_SKIP_INSTALL
  export MRROC_PYTHON=false # nothing of PyPI
  local known=$1 said=$2 status=$3
  cat >stubs/dpkg-query <<STUB
#!/usr/bin/env bash
status=0
for package in "\${@:4}"; do
  if [[ \$package == ${known%% *} ]]; then echo "ii \$package"
  elif [[ " $known " == *" \$package "* ]]; then echo "un \$package"
  else status=1; fi
done
exit \$status
STUB
  cat >stubs/apt-get <<STUB
#!/usr/bin/env bash
echo "apt-get \$*" >>apt.log
echo "$said" >&2
[[ \$* == *update* ]] || exit $status
STUB
  chmod +x stubs/dpkg-query stubs/apt-get
}

packages_that_dpkg_has_never_heard_of_are_installed() {
  debian 'g++ cmake' '' 0
  touch built
  ./run build 2>/dev/null
  said=$(tail -n 1 apt.log)
  says ' install -y '
  says ' cmake '      # known, not installed
  says ' liblcm-dev ' # never heard of
  says_not ' g++ '    # installed
}

who_may_not_install_is_told_what_to_type() {
  debian 'g++' '' 0
  printf '#!/bin/sh\nexit 1\n' >stubs/sudo
  chmod +x stubs/sudo
  local status=0
  # The script itself asks for the user's number: a copy of it has another one.
  sed 's/\$EUID/1000/g' run >run_as_user && chmod +x run_as_user
  said=$(./run_as_user build 2>&1) || status=$?
  ((status == 2)) || fail "status $status"
  says 'type: sudo apt-get update && sudo apt-get install -y --no-install-recommends cmake '
  [[ ! -e apt.log && ! -e build ]] || fail 'something was done'
}

servers_that_are_not_reached_are_told_from_other_failures() {
  debian 'g++' 'W: Failed to fetch http://mirror/dists: Temporary failure resolving mirror' 100
  local status=0
  said=$(./run build 2>&1) || status=$?
  ((status == 1)) || fail "status $status"
  says "error: install_failed: Debian's servers were not reached; look at the network"
  debian 'g++' 'E: dpkg was interrupted' 100
  said=$(./run build 2>&1) || true
  says "error: install_failed: apt-get did not succeed; build/install.log tells why"
}

# A made-up pip, which says what it was called with, then does what is told.
pip() {
  unset MRROC_SKIP_INSTALL
  debian "$(sed -n '/^packages=(/,/)/p' run | tr -d '()' | sed 's/packages=//' | tr '\n' ' ')" '' 0
  sed -i 's/echo "un /echo "ii /' stubs/dpkg-query
  sed -i 's/^\[\[ \$1 == --build/echo "$*" >>cmake.log\n&/' stubs/cmake
  printf '#!/usr/bin/env bash\necho "$*" >>pip.log\n%s\n' "$1" >stubs/python
  chmod +x stubs/python
  export MRROC_PYTHON=python
  touch built cmake/requirements.txt cmake/mujoco.txt
}

without_pypi_a_line_says_so_and_all_but_rex_is_built() {
  pip 'echo "no route to host"; exit 1'
  said=$(./run build 2>&1)
  says 'all is built but the platform Rex'
  says 'the simulator has one engine, Bullet'
  says_not 'no route to host' # which is in the log
  said=$(cat cmake.log)
  says '-D MRROC_REX=OFF -D MRROC_MUJOCO=OFF'
  mkdir -p tasks/rex_drive
  touch tasks/rex_drive/main.cpp
  said=$(./run rex_drive 2>&1) && fail 'the task of Rex is built'
  says 'error: install_failed: rex_drive needs CasADi from PyPI'
}

casadi_is_installed_once_and_only_what_is_needed_of_it() {
  export MRROC_MUJOCO=OFF
  pip 'while [[ $1 != --target ]]; do shift; done
    mkdir -p "$2"/casadi/include/licenses/{casadi,hpipm-external,blasfeo-external,highs}
    cd "$2/casadi"
    touch __init__.py casadi.py _casadi.so libcasadi.so.3 libhpipm.so libblasfeo.so.0 libipopt.so
    touch include/{hpipm_common.h,blasfeo.h,highs.h}'
  said=$(./run build 2>&1 && ./run build 2>&1)
  said=$(cat pip.log)
  says '--no-compile --no-deps --require-hashes --only-binary :all:'
  [[ $(wc -l <pip.log) == 1 ]] || fail 'it is installed again'
  [[ -e build/python/casadi/libhpipm.so && -e build/python/casadi/include/hpipm_common.h ]] || fail 'something is missing'
  [[ ! -e build/python/casadi/libipopt.so && ! -e build/python/casadi/include/licenses/highs ]] || fail 'there is too much'
  said=$(cat cmake.log)
  says '-D MRROC_REX=ON -D MRROC_MUJOCO=OFF'
}

mujoco_is_installed_once_and_only_what_is_needed_of_it() {
  export MRROC_CASADI=/opt/casadi
  pip 'while [[ $1 != --target ]]; do shift; done
    mkdir -p "$2"/mujoco/include/mujoco "$2"/mujoco-9.dist-info/licenses
    cd "$2"
    touch mujoco/{libmujoco.so.9,_render.so,include/mujoco/mujoco.h} mujoco-9.dist-info/licenses/LICENSE'
  touch cmake/mujoco.txt
  said=$(./run build 2>&1 && ./run build 2>&1)
  said=$(cat pip.log)
  says '--require-hashes --only-binary :all: --python-version 3.11 --implementation cp --abi cp311'
  [[ $(wc -l <pip.log) == 1 ]] || fail 'it is installed again'
  [[ -e build/mujoco/mujoco/libmujoco.so.9 && -e build/mujoco/mujoco/include/mujoco/mujoco.h ]] || fail 'something is missing'
  [[ -e build/mujoco/mujoco-9.dist-info/licenses/LICENSE && ! -e build/mujoco/mujoco/_render.so ]] || fail 'not what is needed'
  said=$(cat cmake.log)
  says "-D MRROC_MUJOCO=$PWD/build/mujoco/mujoco"
}

a_task_builds_only_what_it_starts_and_the_viewer_where_it_is_wanted() {
  touch tasks/sketch/main.cpp
  mkdir -p build/release/bin
  printf '#!/bin/sh\n' >build/release/bin/sketch
  chmod +x build/release/bin/sketch
  sed -i 's/^\[\[ \$1 == --build/echo "$*" >>cmake.log\n&/' stubs/cmake
  ./run sketch 2>/dev/null
  said=$(tail -n 1 cmake.log)
  says '--target sketch'
  says_not 'ui_cli'
  ./run sketch --view 2>/dev/null
  said=$(tail -n 1 cmake.log)
  says '--target sketch ui_cli'
}

a_campaign_builds_its_task_and_its_help_builds_nothing() {
  printf '#!/bin/sh\necho "campaign $*, called $MRROC_CALLED in $PYTHONPATH"\n' >stubs/python
  chmod +x stubs/python
  export MRROC_PYTHON=python
  touch tasks/sketch/main.cpp
  said=$(./run campaign sketch --help 2>&1 && ./run campaign 2>&1 && ./run campaign compare a b 2>&1)
  says "campaign -m mrroc_campaign sketch --help, called ./run in $clone/ui_cli/python"
  [[ ! -e build ]] || fail 'it made a build folder'
  sed -i 's/^\[\[ \$1 == --build/echo "$*" >>cmake.log\n&/' stubs/cmake
  local words
  for words in 'sketch --seeds 1:9' 'tune sketch --for height'; do
    rm -f cmake.log
    # shellcheck disable=SC2086  # a list
    said=$(./run campaign $words 2>&1)
    says "campaign -m mrroc_campaign $words, called"
    said=$(tail -n 1 cmake.log)
    says '--target sketch'
  done
}

what_a_check_is_given_is_judged_before_anything_is_done() {
  local words status
  if command -v git >/dev/null; then
    git init -q . && git -c user.name=a -c user.email=a@b commit -q --allow-empty -m made-up
  fi
  for words in '--tidy --share 3' '--tidy --share 3/3' '--since HEAD' '--share 0/2' '--asan --share 2/2' '--tidy --since nowhere' '--tidy --minutes x' '--since' '--usan' '--format -R X' '-R X --tidy' '--all -R X' '--fuzz -R X' '--minutes 2' '--asan --minutes 2' '--fuzz --minutes 0'; do
    status=0
    # shellcheck disable=SC2086  # a list
    said=$(./run test $words 2>&1) || status=$?
    ((status == 2)) || fail "$words: status $status"
    says 'error: bad_usage: '
    [[ ! -e build ]] || fail "$words made a build folder"
  done
}

a_filtered_test_says_that_all_tests_are_built() {
  said=$(./run test -R Nothing 2>&1) || true
  says 'all tests'
}

"$2"
