// Manual operation: the operator moves idle arms by instructions, with the same drivers, guards and log as a task.
#include "launch/task.hpp"
#include "tasks/manual/cell/arm_reach.hpp"
#include "tasks/manual/config.hpp"
#include "tasks/manual/coordinator.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

constexpr const char* kWordsFile = "manual.words";  // in the run folder

manual::ManualParameters read_parameters(const launch::Setup& s, const fs::path& words) {
  manual::ManualParameters k{.arms = manual::read_arms(s.config), .script = {}, .record = {}};
  for (const manual::ArmInfo& arm : k.arms)
    k.macrostep_s = manual::read_memory(s.config, arm.key).pacing.macrostep_s();
  const fs::path script = s.options.check.empty() ? words : s.options.check / kWordsFile;
  if (!script.empty()) k.script = manual::load_script(script, k.arms);
  return k;
}

}  // namespace

int main(int argc, char** argv) {
  fs::path words;
  manual::ManualParameters k;
  return launch::run_task(
      {.name = "manual",
       .about =
           "Manual operation: two idle arms do what `ui_cli manual` tells them - homing, moves and jogs in "
           "motors, "
           "joints and poses,\npresets, tools, models, servo algorithms, gripper, force bias, reset - until "
           "`ui_cli manual end`.",
       .config = manual::config(),
       .arms = {{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}},
       .ecp = manual::run_manual_ecp,
       .options =
           [&](CommandLine& line) {
             line.option("--words", words, "instructions that need no terminal: lines MACROSTEP WORDS...")
                 .type_name("FILE");
           },
       .relations =
           [](CommandLine& line) {
             line.named("--speed").about(
                 "simulated seconds per second in lock-step, or max (default: 1, with --words max)");
           },
       // A user who gives the instructions by hand wants motions that last as long as those of an arm.
       .found =
           [&](mp::TaskOptions& o) {
             if (!o.speed_asked && words.empty() && o.clock == ClockKind::step) o.speed = 1;
             return std::vector<std::string>{};
           },
       .prepare = [&](const launch::Setup& s) { k = read_parameters(s, words); },
       .unattended = ": `ui_cli manual WORDS`, and `ui_cli manual end`",
       .files = [&](const fs::path& folder) { k.record = folder / kWordsFile; },
       .coordinator = [&](mp::TaskRun& run,
                          const launch::Setup&) { return std::make_unique<manual::ManualRun>(run, k); }},
      argc, argv);
}
