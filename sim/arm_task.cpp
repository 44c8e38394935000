#include "sim/arm_task.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "base/command_line.hpp"
#include "base/text_file.hpp"
#include "mp/check_run.hpp"
#include "mp/figure_table.hpp"
#include "mp/gnuplot.hpp"
#include "mp/solo_run.hpp"
#include "mp/step_forces.hpp"
#include "mp/summary_text.hpp"
#include "mp/task_run.hpp"
#include "mp/tell.hpp"

namespace mrroc::sim {
namespace {

namespace fs = std::filesystem;

void write_tables(const fs::path& folder, const std::vector<mp::ArmTrace>& traces) {
  for (std::size_t arm = 0; arm < traces.size(); ++arm)
    mp::write_arm_trace(folder / fmt::format("arm{}.csv", arm + 1), traces[arm]);
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  if (fs::is_directory(folder / "plots"))
    for (const auto& entry : fs::directory_iterator(folder / "plots"))
      if (entry.path().extension() == ".png") pictures.push_back(entry.path());
  std::ranges::sort(pictures);
  return pictures;
}

mp::SoloParameters solo_parameters(const ArmTask& task, const mp::TaskOptions& options,
                                   const Config& config) {
  mp::SoloParameters k;
  for (const CellArm& arm : task.arms) k.arms.push_back(arm.key);
  k.behaviours = task.behaviours;
  k.dt = config.number("time.dt", k.dt, {0.002, 0.002}, "s");
  k.n_s = config.integer("time.n_s", task.n_s, {task.n_s, task.n_s}, "steps");
  k.coordinate = task.coordinate;
  k.gives_start = !options.attended && options.script.empty();
  return k;
}

/// Figures that the supervisor makes of every run.
constexpr std::array kEveryRun{
    mp::FigureInfo{
        .key = "stop_steps_max", .words = "steps until the arms were at rest", .unit = "", .high = 100},
    mp::FigureInfo{.key = "late_periods", .words = "late periods of all processes", .unit = ""},
    mp::FigureInfo{
        .key = "log_gaps", .words = "messages that the log missed", .unit = "", .low = 0, .high = 0}};

/// Files, figures and pictures of a run that has ended.
/// @param known  gets what the figures mean, in the order of the table
void finish(const ArmTask& task, const Config& config, const fs::path& folder,
            std::vector<mp::ArmTrace> traces, mp::Summary& summary, std::vector<mp::FigureInfo>& known) {
  write_tables(folder, traces);
  const link::LogReader log(folder / "events.lcmlog");
  for (std::size_t arm = 0; arm < traces.size(); ++arm)
    mp::add_step_forces(traces[arm], log, task.arms[arm].key);
  if (task.figures)
    for (mp::TaskFigure& figure : task.figures(traces, config)) {
      known.push_back(figure.info);
      summary.figures.emplace(figure.info.key, std::move(figure.value));
    }
  known.insert(known.end(), kEveryRun.begin(), kEveryRun.end());
  mp::write_summary(folder, summary);
  const bool moved = std::ranges::any_of(traces, [](const mp::ArmTrace& trace) { return !trace.empty(); });
  if (task.pictures && moved) draw(folder, task.pictures(traces, config));
}

int run(const ArmTask& task, mp::TaskOptions& options) {
  Config config = load_task_config(options, task.config, task.name);
  options.seed = seed_of(config);
  const mp::SoloParameters k = solo_parameters(task, options, config);
  read_cell(config, task.arms, options.seed);
  if (task.read) task.read(config);
  for (const Receptor& r : task.receptors)
    if (r.read) r.read(config);
  if (task.figures) task.figures(std::vector<mp::ArmTrace>(task.arms.size()), config);  // reads its keys
  check_task_options(options);
  if (!options.check.empty()) return mp::check_solo_run(task.name, options, k);
  const fs::path folder = mp::name_run_folder(options.run_dir, task.name);
  complete_config(config, options, folder, "");
  mp::make_run_folder(folder);
  mp::write_text(folder / "config.toml", config.dump());

  auto parts = cell_parts(config, task.arms);
  for (const CellArm& arm : task.arms) {
    parts.push_back(make_part(config, "ecp-" + arm.key, "ecp_" + task.name, &arm, task.ecp));
    for (const Receptor& r : task.receptors)
      parts.push_back(
          make_part(config, fmt::format("vsp-{}-{}", r.name, arm.key), "vsp_" + r.name, &arm, r.body));
  }
  mp::TaskRun run(task.name, options, folder, k.arms, std::move(parts));
  const auto tell = [&options](const std::string& line) { mp::tell(line, options.session); };
  tell(fmt::format("{}, session {}, seed {}{}", task.name, run.session(), options.seed,
                   mp::who_orders(options)));
  mp::SoloRun solo(run, k, tell);
  run.start();
  std::optional<Fault> fault;
  if (run.process().assemble() && solo.execute() == Outcome::faulted) fault = solo.fault();
  mp::Summary summary = run.end(fault);
  std::vector<mp::FigureInfo> known;
  try {
    run.finish([&] { finish(task, config, folder, solo.traces(), summary, known); });
  } catch (const FaultError& e) {  // what has been done is told all the same
    if (!summary.fault) summary.fault = e.fault();
  }
  std::vector<std::string_view> columns(k.arms.begin(), k.arms.end());
  mp::Ending ending{.folder = folder,
                    .figures = mp::figure_table(summary.figures, known, columns, !summary.fault),
                    .pictures = pictures_in(folder)};
  if (task.result && !summary.fault && !summary.stopped) ending.figures += task.result(solo.traces());
  return mp::print_ending(summary, ending, options);
}

}  // namespace

constexpr int kColumnOfForce = 10;  // in arm1.csv

std::vector<Picture> force_picture(Axis axis, double desired) {
  return {{"force",
           fmt::format("set xlabel 't [s]'\nset ylabel 'F_{0} [N]'\nset key right top\n"
                       "plot 'arm1.csv' skip 1 using 2:{1}:3 with lines lw 1.6 lc variable "
                       "title 'measured; colour: behaviour', {2} with lines dt 2 lc rgb '#8a94a3' "
                       "title 'desired'\n",
                       "xyz"[static_cast<int>(axis)], kColumnOfForce + static_cast<int>(axis), desired)}};
}

void draw(const fs::path& folder, const std::vector<Picture>& pictures) {
  for (const Picture& p : pictures) {
    const fs::path script = fs::path("plots") / (p.name + ".gp");
    write_text_file(folder / script,
                    fmt::format("# Run it in the run folder: gnuplot plots/{0}.gp\n"
                                "set terminal pngcairo size 1000,620 font 'sans,12' background rgb 'white'\n"
                                "set output 'plots/{0}.png'\nset datafile separator ','\n"
                                "set border 3\nset tics nomirror\nset grid lc rgb '#e4e8ee'\n{1}",
                                p.name, p.script));
    const mp::GnuplotResult result = mp::run_gnuplot(folder, script);
    if (result == mp::GnuplotResult::failed)
      mp::tell(fmt::format("gnuplot could not draw {}.png; see plots/gnuplot.log", p.name));
    if (result != mp::GnuplotResult::absent) continue;
    mp::tell("gnuplot is not installed, so there are no pictures of the run");
    return;
  }
}

int run_arm_task(const ArmTask& task, int argc, char** argv) {
  mp::TaskOptions options;
  CommandLine line(task.about, task.name);
  mp::add_task_options(line, options);
  return mp::run_command_line(line, argc, argv, [&] { return run(task, options); });
}

}  // namespace mrroc::sim
