#!/usr/bin/env bash
# Lets ui_cli write a robot, a platform, a sensor and three tasks into an empty tree, builds them against what has been built, runs
# their tests and them: generated.sh SOURCE BUILD
set -euo pipefail
source=$1 build=$2
place=$(mktemp -d "${TMPDIR:-/tmp}/mrroc-new.XXXXXX")
trap 'rm -rf "$place"' EXIT
tree=$place/tree
bin=$place/build/bin

fail() {
  echo "FAILED: $*" >&2
  exit 1
}

cp -r "$source/test/new/tree" "$tree"
for folder in robots tasks vsp test/robots test/tasks test/vsp; do
  mkdir -p "$tree/$folder"
  : >"$tree/$folder/CMakeLists.txt"
done
cp "$source/tasks/CMakeLists.txt" "$tree/tasks"
cp "$source/test/tasks/CMakeLists.txt" "$tree/test/tasks"
: >"$tree/run"

ui() { (cd "$tree" && "$build/bin/ui_cli" new "$@"); }
ui robot probe_arm --hardware >"$place/robot.txt"
ui platform probe_car >"$place/platform.txt"
ui sensor probe_sensor >"$place/sensor.txt"
ui task probe_task --sensor probe_sensor >"$place/task.txt"
# A task with a coordinator of its own changes nothing outside of its folder.
before=$(find "$tree" -type f -exec md5sum {} + | sort)
ui task probe_pair --coordinated >"$place/pair.txt"
after=$(find "$tree" -type f -not -path '*/tasks/probe_pair/*' -exec md5sum {} + | sort)
[[ $before == "$after" ]] || fail "files outside of tasks/probe_pair have changed"
(($(find "$tree/tasks/probe_pair" -type f | wc -l) <= 6)) || fail "more than six files"
grep -q './run probe_arm' "$place/robot.txt" || fail "the next step is not told"
grep -q 'platforms.rex.model=probe_car' "$place/platform.txt" || fail "the next step of a platform is not told"
if ui task probe_task 2>"$place/error"; then fail "what is there was written once more"; fi
grep -q 'error: bad_usage' "$place/error" || fail "no reason was given"

if command -v clang-format >/dev/null; then
  cp "$source/.clang-format" "$tree"
  find "$tree" -name '*.[hc]pp' -print0 | xargs -0 clang-format --dry-run -Werror || fail "it is not formatted"
fi

cmake -S "$tree" -B "$place/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE='-O1 -DNDEBUG' \
  -DMRROC_TREE="$source" -DMRROC_BUILD="$build" >"$place/configure.log"
cmake --build "$place/build" >"$place/build.log" || { tail -n 40 "$place/build.log"; fail "it does not build"; }
cp "$build/bin/edp_irb6" "$build/bin/ecp_press" "$build/bin/ecp_transparent" "$build/bin/ui_cli" "$bin"  # programs are looked for beside each other

for suite in "$bin"/test_*; do
  "$suite" --gtest_brief=1 >"$place/suite.log" 2>&1 || { cat "$place/suite.log"; fail "$(basename "$suite")"; }
done

# run TASK [options]: it comes to its end, its figures are as wanted, and its log can be recomputed
run() {
  local name=$1 folder=$place/run-$1-$#
  timeout 120 "$bin/$name" --run-dir "$folder" "${@:2}" >"$place/run.log" 2>&1 || { cat "$place/run.log"; fail "$name"; }
  grep -q ' ok$' "$place/run.log" || { cat "$place/run.log"; fail "$name judged nothing"; }
  if grep -q 'NOT OK' "$place/run.log"; then cat "$place/run.log"; fail "$name: a figure is not as wanted"; fi
  "$bin/ui_cli" log check "$folder" >"$place/check.log" 2>&1 || { cat "$place/check.log"; fail "$name: log check"; }
}
run probe_arm
run probe_task --processes one
run probe_pair
[[ -s $place/run-probe_pair-1/plots/force.gp && -s $place/run-probe_pair-1/arm2.csv ]] || fail "probe_pair: no plot or table"
# Any other task on this robot.
run press --set robots.arm1.model=probe_arm
# What is told for its own hardware: it homes, and goes towards a surface that the loop-back has not.
told=$(sed -n 's|^ *\./run \(probe_arm --clock wall .*[^ ]\) *#.*|\1|p' "$place/robot.txt")
[[ -n $told ]] || fail "no line for the robot's own hardware is told"
read -ra typed <<<"$told"
timeout 120 "$bin/${typed[0]}" "${typed[@]:1}" --max-time 30 --run-dir "$place/run-hardware" >"$place/run.log" 2>&1 || true
grep -qE 'm = 1  approach|host_too_slow' "$place/run.log" || { cat "$place/run.log"; fail "its own hardware"; }
# It is not believed to stand where the simulated one does.
if "$bin/probe_arm" --set robots.arm1.hardware=probe_arm --run-dir "$place/run-nowhere" 2>"$place/error"; then
  fail "an arm with hardware of its own began without a position"
fi
grep -q 'robots.arm1.synchro_joints' "$place/error" || { cat "$place/error"; fail "the missing position is not named"; }
# Manual operation moves it, and refuses what is beyond its ranges before it moves.
printf '%s\n' '5 home arm1' '80 jog arm1 joints 0.01 0 0 0 0 0 speed 0.5 acceleration 0.2' \
  '160 jog arm1 joints 50 0 0 0 0 0' '180 end' >"$place/words"
timeout 120 "$bin/manual" --run-dir "$place/run-manual" --words "$place/words" --set robots.arm1.model=probe_arm \
  --set 'robots.arm1.synchro="known_pose"' >"$place/run.log" 2>&1 || { cat "$place/run.log"; fail "manual"; }
[[ $(grep -c 'arm1  move' "$place/run.log") == 1 ]] || { cat "$place/run.log"; fail "manual: the arm shall move once"; }
"$bin/ui_cli" log check "$place/run-manual" >"$place/check.log" 2>&1 || { cat "$place/check.log"; fail "manual: log check"; }
echo "all that was written builds, passes its tests and runs"
