// Manual operation: the operator moves idle arms by instructions, with the same drivers, guards and log as a task.
#include <fmt/core.h>

#include <cstdio>

#include "base/command_line.hpp"
#include "mp/check_run.hpp"
#include "mp/summary_text.hpp"
#include "mp/task_run.hpp"
#include "mp/tell.hpp"
#include "sim/arm_reach.hpp"
#include "sim/cell_parts.hpp"
#include "tasks/manual/config.hpp"
#include "tasks/manual/coordinator.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

const std::vector<sim::CellArm> kArms{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};
constexpr const char* kWordsFile = "manual.words";  // in the run folder

struct Options {
  mp::TaskOptions task;
  fs::path words;
};

/// Everything that is known before anything starts.
struct Setup {
  Config config;
  manual::ManualParameters k;
  std::vector<std::string> keys;
};

Setup prepare(Options& o) {
  Setup s;
  s.config = sim::load_task_config(o.task, manual::config(), "manual");
  o.task.seed = sim::seed_of(s.config);
  sim::read_cell(s.config, kArms, o.task.seed);
  s.k.arms = manual::read_arms(s.config);
  for (const manual::ArmInfo& arm : s.k.arms) {
    s.keys.push_back(arm.key);
    s.k.macrostep_s = manual::read_memory(s.config, arm.key).pacing.macrostep_s();
  }
  const fs::path words = o.task.check.empty() ? o.words : o.task.check / kWordsFile;
  if (!words.empty()) s.k.script = manual::load_words(words, s.k.arms);
  sim::check_task_options(o.task);
  return s;
}

std::vector<mp::Part> parts_of(const Config& config) {
  auto parts = sim::cell_parts(config, kArms);
  for (const sim::CellArm& arm : kArms)
    parts.push_back(sim::make_part(config, "ecp-" + arm.key, "ecp_manual", &arm, sim::run_manual_ecp));
  return parts;
}

int check(const Options& o, const Setup& s) {
  return mp::check_coordinator("manual", o.task, s.keys, [&](mp::TaskRun& run) {
    manual::ManualRun manual(run, s.k, [](const std::string&) {});
    if (run.process().assemble()) manual.execute();
  });
}

/// Who gives the instructions by hand wants motions that last as long as those of an arm.
mp::TaskOptions paced(const Options& o) {
  mp::TaskOptions task = o.task;
  if (!task.speed_asked && o.words.empty() && task.clock == ClockKind::step) task.speed = 1;
  return task;
}

int run(Options& o) {
  Setup s = prepare(o);
  if (!o.task.check.empty()) return check(o, s);
  const fs::path folder = mp::name_run_folder(o.task.run_dir, "manual");
  sim::complete_config(s.config, o.task, folder, "");
  mp::make_run_folder(folder);
  mp::write_text(folder / "config.toml", s.config.dump());
  s.k.record = folder / kWordsFile;

  mp::TaskRun run("manual", o.task, folder, s.keys, parts_of(s.config));
  const auto tell = [&o](const std::string& line) { mp::tell(line, o.task.session); };
  tell(fmt::format("manual operation, session {}, seed {}: `ui_cli manual WORDS`, and `ui_cli manual end`",
                   run.session(), o.task.seed));
  manual::ManualRun manual(run, s.k, tell);
  run.start();
  std::optional<Fault> fault;
  if (run.process().assemble() && manual.execute() == Outcome::faulted) fault = manual.fault();
  const mp::Summary summary = run.end(fault);
  mp::write_summary(folder, summary);
  return mp::print_ending(summary, {.folder = folder}, o.task);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CommandLine line(
      "Manual operation: two idle arms do what `ui_cli manual` tells them - homing, moves and jogs in "
      "motors, joints "
      "and poses,\npresets, tools, models, servo algorithms, gripper, force bias, reset - until `ui_cli "
      "manual end`.",
      "manual");
  line.option("--words", o.words, "instructions that need no terminal: lines MACROSTEP WORDS...")
      .type_name("FILE");
  mp::add_task_options(line, o.task);
  line.named("--speed").about(
      "simulated seconds per second in lock-step, or max (default: 1, with --words max)");
  return mp::run_command_line(line, argc, argv, [&] {
    o.task = paced(o);
    return run(o);
  });
}
