// The drawing task: two arms copy a drawing that is taught to one of them.
#include <fmt/core.h>

#include <cstdio>

#include "base/command_line.hpp"
#include "base/config.hpp"
#include "mp/check_run.hpp"
#include "mp/summary_text.hpp"
#include "mp/task_run.hpp"
#include "mp/tell.hpp"
#include "sim/cell_parts.hpp"
#include "tasks/drawing/config.hpp"
#include "tasks/drawing/drawing_run.hpp"
#include "tasks/drawing/ecp_body.hpp"
#include "tasks/drawing/figure_info.hpp"
#include "tasks/drawing/input.hpp"
#include "tasks/drawing/plots.hpp"
#include "tasks/drawing/results.hpp"
#include "vsp/pen_state/config.hpp"

namespace {

using namespace mrroc;
namespace fs = std::filesystem;

const std::vector<std::string> kArmKeys{"arm1", "arm2"};
const std::vector<sim::CellArm> kArms{{"arm1", "irb6_postument"}, {"arm2", "irb6_track"}};

constexpr const char* kLoaded = "loaded.recording";  // in the run folder

struct Options {
  mp::TaskOptions task;
  drawing::InputOptions input;
};

/// Everything that is known before anything starts.
struct Setup {
  Config config;
  drawing::Parameters k;
  drawing::HandPlan plan;
  drawing::Input input;
  drawing::PlotSetup sheets;
};

/// Reads every parameter of every process, so that a wrong one is found before anything starts.
void read_all(Setup& s, const mp::TaskOptions& o) {
  const Config& c = s.config;
  s.k = drawing::read_parameters(c);
  s.plan = drawing::read_hand_plan(c, s.input.start());
  s.plan.gives_orders = !o.attended && o.script.empty();
  const sim::WorldParameters world = sim::read_cell(c, kArms, o.seed);
  for (std::size_t arm = 0; arm < kArms.size(); ++arm) s.sheets.sheet[arm] = world.arms[arm].paper.T_0P.p;
  vsp::read_pen_state(c);
}

/// What a run had loaded is in its folder; where its pens began is in its configuration.
drawing::InputOptions input_of_run(const fs::path& folder) {
  drawing::InputOptions o;
  if (fs::exists(folder / kLoaded)) o.load = folder / kLoaded;
  return o;
}

/// @throws FaultError  what is wrong with the input; nothing has been made or started
Setup prepare(Options& o) try {
  Setup s;
  s.input = drawing::read_input(o.task.check.empty() ? o.input : input_of_run(o.task.check));
  s.config = sim::load_task_config(o.task, drawing::default_config(), "drawing");
  o.task.seed = sim::seed_of(s.config);
  read_all(s, o.task);
  if (s.input.taught) drawing::check_macrostep(*s.input.taught, s.k, o.input.load.string());
  sim::check_task_options(o.task);
  return s;
} catch (const FileError& e) {
  throw FaultError(o.input.load.empty() ? FaultCode::bad_drawing : FaultCode::bad_recording, e.wrong(),
                   e.remedy());
}

std::vector<mp::Part> parts_of(const Config& config) {
  auto parts = sim::cell_parts(config, kArms);
  for (const sim::CellArm& arm : kArms) {
    parts.push_back(sim::make_part(config, "ecp-" + arm.key, "ecp_drawing", &arm, drawing::run_drawing_ecp));
    parts.push_back(sim::make_part(config, "vsp-" + arm.key, "vsp_pen_state", &arm, vsp::run_pen_state));
  }
  return parts;
}

/// @return a line when the pen did not leave as many strokes as it was to draw; usually they are too close
std::string stroke_warning(const mp::Summary& s) {
  const auto number = [&](const char* key) {
    const auto found = s.figures.find(key);
    return found == s.figures.end() ? -1 : std::get<double>(found->second);
  };
  const double input = number("strokes_input"), taught = number("strokes_taught");
  if (s.fault || input < 0 || taught < 0 || input == taught) return "";
  return fmt::format(
      "warning: the input has {:g} strokes and {:g} were taught: see the left part of drawing.png; draw it "
      "larger, or "
      "with strokes farther apart\n",
      input, taught);
}

/// Files, figures and pictures of a run that has ended.
void finish(const Options& o, const Setup& s, const fs::path& folder, const drawing::RunRecord& record,
            mp::Summary& summary) {
  const bool taught_here = !s.input.taught;
  const auto ink =
      drawing::collect_ink(folder, kArmKeys, taught_here ? std::nullopt : std::optional(s.input.taught->ink));
  drawing::write_tables(folder, record, ink);
  for (auto& [key, figure] :
       drawing::figures_of(s.input.drawing, taught_here, record, ink, s.k, !summary.fault))
    summary.figures[key] = figure;
  mp::write_summary(folder, summary);
  if (!o.input.save.empty()) {
    if (record.whole && ink.taught)
      drawing::save(o.input.save, {record.recording, *ink.taught});
    else
      mp::tell(
          fmt::format("{} was not written: the teach-in has not come to its end", o.input.save.string()));
  }
  const auto plots = drawing::plot_run(folder, s.sheets);
  if (!plots.note.empty()) mp::tell(plots.note);
}

/// Runs the coordinator on the log of a run.
int check(const Options& o, const Setup& s) {
  drawing::HandPlan plan = s.plan;
  plan.gives_orders = false;
  return mp::check_coordinator("drawing", o.task, kArmKeys, [&](mp::TaskRun& run) {
    drawing::DrawingRun drawing(run, kArmKeys, s.k, plan,
                                s.input.taught ? std::optional(s.input.taught->recording) : std::nullopt,
                                [](const std::string&) {});
    if (run.process().assemble()) drawing.execute();
  });
}

int run(Options& o) {
  Setup s = prepare(o);
  if (!o.task.check.empty()) return check(o, s);
  const fs::path folder = mp::name_run_folder(o.task.run_dir, "drawing");
  sim::complete_config(s.config, o.task, folder, fs::absolute(folder / "input.csv").string());
  mp::make_run_folder(folder);
  drawing::write_ink(folder / "input.csv", drawing::ink_of(s.input.drawing));
  if (s.input.taught) drawing::save(folder / kLoaded, *s.input.taught);
  mp::write_text(folder / "config.toml", s.config.dump());

  mp::TaskRun run("drawing", o.task, folder, kArmKeys, parts_of(s.config));
  const auto tell = [&o](const std::string& line) { mp::tell(line, o.task.session); };
  tell(fmt::format("drawing, {}, session {}, seed {}{}", s.input.about(), run.session(), o.task.seed,
                   s.plan.gives_orders ? ", unattended: the scripted operator gives start and triggers"
                                       : mp::who_orders(o.task)));
  drawing::DrawingRun drawing(run, kArmKeys, s.k, s.plan,
                              s.input.taught ? std::optional(s.input.taught->recording) : std::nullopt, tell);
  run.start();
  std::optional<Fault> fault;
  if (run.process().assemble() && drawing.execute() == Outcome::faulted) fault = drawing.fault();
  mp::Summary summary = run.end(fault);
  try {
    run.finish([&] { finish(o, s, folder, drawing.record(), summary); });
  } catch (const FaultError& e) {  // what has been done is told all the same
    if (!summary.fault) summary.fault = e.fault();
  } catch (const FileError& e) {  // a table that the world could not write to its end
    if (!summary.fault) summary.fault = Fault{.code = FaultCode::cannot_write, .text = e.what()};
  }
  mp::Ending ending{.folder = folder,
                    .figures = mp::figure_table(summary.figures, drawing::kFigures, drawing::kFigureColumns,
                                                !summary.fault) +
                               stroke_warning(summary)};
  if (const fs::path picture = folder / "plots" / "drawing.png"; fs::exists(picture))
    ending.pictures.push_back(picture);
  return mp::print_ending(summary, ending, o.task);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  CommandLine line(
      "Two simulated IRb-6 arms copy a drawing that an operator teaches to one of them by leading its pen.\n"
      "Without options the built-in arrow with six feathers is taught and copied.",
      "drawing");
  drawing::add_input_options(line, o.input);
  mp::add_task_options(line, o.task);
  return mp::run_command_line(line, argc, argv, [&] { return run(o); });
}
