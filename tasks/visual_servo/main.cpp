// The visual servoing task: an arm brings its tool to a pose before an object that cameras see, and follows it.
#include <fmt/core.h>

#include <cstdio>

#include "base/command_line.hpp"
#include "mp/check_run.hpp"
#include "mp/solo_run.hpp"
#include "mp/summary_text.hpp"
#include "mp/task_run.hpp"
#include "mp/tell.hpp"
#include "sim/arm_task.hpp"
#include "sim/camera/config.hpp"
#include "tasks/visual_servo/config.hpp"
#include "tasks/visual_servo/figure_info.hpp"
#include "tasks/visual_servo/plots.hpp"
#include "tasks/visual_servo/program.hpp"
#include "tasks/visual_servo/scenario.hpp"
#include "tasks/visual_servo/servo_record.hpp"
#include "vsp/image_receptor.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

const std::vector<std::string> kArmKeys{std::string(visual_servo::kArm)};
const std::vector<sim::CellArm> kArms{{kArmKeys[0], "irb6_postument"}};

struct Options {
  mp::TaskOptions task;
  visual_servo::ScenarioOptions scenario;
};

/// Everything that is known before anything starts.
struct Setup {
  Config config;
  visual_servo::Parameters k;
  visual_servo::Object object{};
};

/// Reads every parameter of every process, so that a wrong one is found before anything starts.
Setup prepare(Options& o) {
  Setup s;
  s.config = sim::load_task_config(o.task, visual_servo::config(), "visual_servo",
                                   visual_servo::settings_of(o.scenario));
  o.task.seed = sim::seed_of(s.config);
  s.k = visual_servo::read_parameters(s.config);
  s.object = visual_servo::read_object(s.config);
  sim::read_cell(s.config, kArms, o.task.seed);
  sim::read_camera_world(s.config, kArmKeys);
  const vsp::ImageReceptor& receptor =
      s.object == visual_servo::Object::chessboard ? vsp::chessboard_receptor() : vsp::apriltag_receptor();
  for (const std::string& key : camera_keys(s.config))
    receptor.make(read_camera_model(s.config, key), s.config);
  sim::check_task_options(o.task);
  return s;
}

std::vector<mp::Part> parts_of(const Setup& s) {
  auto parts = sim::cell_parts(s.config, kArms);
  const bool board = s.object == visual_servo::Object::chessboard;
  for (const std::string& key : camera_keys(s.config))
    parts.push_back(sim::make_part(s.config, "vsp-" + key, board ? "vsp_chessboard" : "vsp_apriltag", nullptr,
                                   board ? vsp::run_chessboard : vsp::run_apriltag));
  parts.push_back(sim::make_part(s.config, "ecp-" + kArmKeys[0], "ecp_visual_servo", kArms.data(),
                                 visual_servo::run_ecp));
  return parts;
}

mp::SoloParameters solo_parameters(const Options& o, const Setup& s) {
  mp::SoloParameters k;
  k.arms = kArmKeys;
  k.behaviours.resize(static_cast<std::size_t>(visual_servo::kGiveUp.m));
  const auto add = [&k](const auto& row) {
    k.behaviours[static_cast<std::size_t>(row.m - 1)] = {std::string(row.name), std::string(row.until)};
  };
  for (const visual_servo::Selectable& row : visual_servo::kBehaviours) add(row.motion);
  add(visual_servo::kGiveUp);
  k.lasts = s.k.duration;
  k.dt = s.k.pacing.dt;
  k.n_s = s.k.pacing.n_s;
  k.gives_start = !o.task.attended && o.task.script.empty();
  return k;
}

/// Files, figures and pictures of a run that has ended.
void finish(const Setup& s, const fs::path& folder, const mp::SoloRun& solo,
            const visual_servo::ServoRecord& record, mp::Summary& summary) {
  mp::write_arm_trace(folder / "arm1.csv", solo.traces()[0]);
  const auto table = visual_servo::join(record.reports(), record.truths(), s.k.T_EGd, s.k.pacing.dt);
  visual_servo::write_servo_table(folder / "servo.csv", table);
  summary.figures.merge(visual_servo::figures_of(table));
  mp::write_summary(folder, summary);
  if (table.empty()) return;  // it ended before the first control step
  std::vector<sim::Picture> pictures;
  for (const auto& [name, script] : visual_servo::plots()) pictures.push_back({name, script});
  sim::draw(folder, pictures);
}

std::string situation(const Options& o) {
  if (!o.task.config_file.empty()) return "as in " + o.task.config_file.string();
  return fmt::format("scenario {}, {}", o.scenario.scenario, o.scenario.object);
}

int run(Options& o) {
  Setup s = prepare(o);
  if (!o.task.check.empty()) return mp::check_solo_run("visual_servo", o.task, solo_parameters(o, s));
  const fs::path folder = mp::name_run_folder(o.task.run_dir, "visual_servo");
  sim::complete_config(s.config, o.task, folder, "", true);
  mp::make_run_folder(folder);
  mp::write_text(folder / "config.toml", s.config.dump());

  mp::TaskRun run("visual_servo", o.task, folder, kArmKeys, parts_of(s));
  visual_servo::ServoRecord record(run.process(), kArmKeys[0]);
  mp::SoloParameters k = solo_parameters(o, s);
  k.watch = [&record] { record.collect(); };
  const auto tell = [&o](const std::string& line) { mp::tell(line, o.task.session); };
  tell(fmt::format("visual_servo, {}, session {}, seed {}{}", situation(o), run.session(), o.task.seed,
                   mp::who_orders(o.task)));
  mp::SoloRun solo(run, k, tell);
  run.start();
  std::optional<Fault> fault;
  if (run.process().assemble() && solo.execute() == Outcome::faulted) fault = solo.fault();
  mp::Summary summary = run.end(fault);
  record.collect();
  try {
    run.finish([&] { finish(s, folder, solo, record, summary); });
  } catch (const FaultError& e) {  // what has been done is told all the same
    if (!summary.fault) summary.fault = e.fault();
  }
  return mp::print_ending(
      summary,
      {.folder = folder,
       .figures = mp::figure_table(summary.figures, visual_servo::kFigures, {}, !summary.fault)},
      o.task);
}

void add_scenario_options(CommandLine& line, visual_servo::ScenarioOptions& o) {
  std::vector<std::string> names;
  std::string about = "What the object does:";
  for (const auto& s : visual_servo::scenarios()) {
    names.emplace_back(s.name);
    about += fmt::format("\n{}: {}", s.name, s.about);
  }
  line.option("--scenario", o.scenario, about).one_of(names).show_default();
  line.option("--object", o.object, "What is looked for").one_of({"chessboard", "apriltag"}).show_default();
  line.option("--aggregation", o.aggregation, "How the errors of two cameras become one (default: mean)")
      .one_of({"mean", "switching", "weights"});
  line.option("--cameras", o.cameras,
              "Which cameras there are (default: both). Alone, sac stops when the arm hides the object "
              "from it, and eih must "
              "have the object in view from the beginning (object.pose)")
      .one_of({"both", "sac", "eih"});
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CommandLine line(
      "An arm brings its tool to a pose before an object and follows it when it moves; it sees the object\n"
      "through a camera above the scene (SAC), one in the hand (EIH), or both.",
      "visual_servo");
  add_scenario_options(line, o.scenario);
  mp::add_task_options(line, o.task);
  for (const char* option : {"--scenario", "--object", "--aggregation", "--cameras"})
    line.named("--config").excludes(line.named(option));
  return mp::run_command_line(line, argc, argv, [&] { return run(o); });
}
