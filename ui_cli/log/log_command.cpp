#include "ui_cli/log/log_command.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <ostream>
#include <sstream>
#include <utility>

#include "base/command_line.hpp"
#include "base/fault.hpp"
#include "base/joined.hpp"
#include "ui_cli/log/log_check.hpp"
#include "ui_cli/log/log_compare.hpp"
#include "ui_cli/log/log_csv.hpp"
#include "ui_cli/log/log_plot.hpp"
#include "ui_cli/log/log_show.hpp"
#include "ui_cli/log/log_whole.hpp"
#include "ui_cli/log/platform_fields.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

/// Meaning of the command's words.
struct Words {
  std::vector<fs::path> runs;
  std::string run, other, what;
  std::vector<std::string> fields;
  std::vector<std::string> plotted;  ///< run folders, then what of them
  PlotOptions plot;
  std::string output;
  ShowOptions show;
  bool json{};
  std::function<int(std::ostream& out, std::ostream& err)> command;
};

int write_table(const Words& w, std::ostream& out, std::ostream& err) {
  const RunRecord run(w.run);
  warn_of_damage(run, err);
  std::ofstream file;
  if (!w.output.empty()) {
    file.open(w.output);
    if (!file) throw FaultError(FaultCode::cannot_write, "cannot write " + w.output);
  }
  std::ostream& to = w.output.empty() ? out : file;
  if (w.what.empty())
    write_channels(run, w.json, to);
  else
    write_channel(run, w.what, w.fields, w.json, to);
  if (!to.flush()) throw FaultError(FaultCode::cannot_write, "cannot write " + w.output);
  return 0;
}

/// The last word says what is drawn; without it --fields does.
/// @throws FaultError bad_usage
std::vector<std::string> runs_to_plot(const Words& w, PlotOptions& plot) {
  std::vector<std::string> runs = w.plotted;
  const std::vector<std::string> subjects = plot_subjects();
  const bool says_what = !runs.empty() && std::ranges::find(subjects, runs.back()) != subjects.end();
  if (says_what) {
    plot.what = runs.back();
    runs.pop_back();
  }
  const std::string whole = "type for example `ui_cli log plot runs/press-20260314-101500 force`";
  if (runs.empty()) throw FaultError(FaultCode::bad_usage, "RUN (the run folder) is missing", whole);
  if (says_what || !plot.fields.empty()) return runs;
  if (runs.size() > 1 && !fs::exists(runs.back()))
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("'{}' cannot be drawn, and is no run folder", runs.back()),
                     "plots: " + joined(subjects, ", "));
  throw FaultError(FaultCode::bad_usage,
                   fmt::format("WHAT ({} of arms, {} of platforms) is missing", joined(arm_subjects(), ", "),
                               joined(platform_subjects(), ", ")),
                   whole);
}

int draw(const Words& w, std::ostream& out, std::ostream& err) {
  PlotOptions plot = w.plot;
  std::vector<RunRecord> runs;
  for (const std::string& folder : runs_to_plot(w, plot)) {
    runs.emplace_back(folder);
    warn_of_damage(runs.back(), err);
  }
  const fs::path picture = plot_runs(runs, plot, w.output);
  out << (w.json ? nlohmann::json{{"picture", picture.string()}}.dump() + "\n"
                 : fmt::format("picture: {}\n", picture.string()));
  return 0;
}

int check(const Words& w, std::ostream& out) {
  int status = 0;
  // Several reports are one document: a list.
  const bool list = w.json && w.runs.size() > 1;
  const char* between = "[\n";
  std::ostringstream document;  // nothing of it is printed when one of the runs cannot be read
  for (const fs::path& folder : w.runs) {
    if (list) document << std::exchange(between, ",\n");
    const RunRecord run(folder);
    const std::vector<std::string> changed = changed_programs(run, build_ids_beside());
    if (!w.json) out << changed_programs_line(changed) << std::flush;  // also when they cannot read the run
    const auto verdicts = check_run(run, programs_beside());
    status = std::max(status,
                      report_check(folder, verdicts, changed, damage_of(run), w.json, list ? document : out));
  }
  if (list) out << document.str() << "]\n";
  return status;
}

const Examples kExamples{
    "ui_cli log show runs/press-20260314-101500 --from 1 --to 2",
    "ui_cli log show runs/press-20260314-101500 --channel arm1.reply",
    "ui_cli log csv runs/press-20260314-101500 arm1.reply --fields F_a,T_0E --output reply.csv",
    "ui_cli log plot runs/press-20260314-101500 force --output force.png",
    "ui_cli log plot runs/press-20260314-101500 runs/press-20260314-102000 force --fields F_z --to 5",
    "ui_cli log compare runs/press-20260314-101500 runs/press-20260314-102000",
    "ui_cli log check runs/press-20260314-101500"};

void add_run(CommandLine& command, Words& w) {
  command.option("run", w.run, "the run folder").required().type_name("RUN");
}

void runs(CommandLine& command, Words& w, std::function<int(std::ostream&, std::ostream&)> what) {
  command.flag("--json", w.json, "print JSON");
  command.when_given([&w, what = std::move(what)] { w.command = what; });
}

void add_plot(CommandLine& line, Words& w) {
  CommandLine& plot = line.subcommand(
      "plot",
      "Draw force, pose, motors or behaviours of arms over time, path, error, torques, slip, speeds or "
      "behaviours of platforms; of several runs over one another");
  plot.option("run", w.plotted, "run folders, then what is drawn; that may be left out with --fields")
      .type_name("RUN... WHAT");
  plot.option("--fields", w.plot.fields,
              "only these: F_x..F_z [N], N_x..N_z [N m]; since the first reading shown x y z [mm], rx ry rz "
              "[deg] and "
              "turned[k] [rad]; T_0E[k] [m, rad], gripper [mm], motors[k], joints[k] [rad, m], "
              "current_mean[k] [A], m. Of platforms as in platform.csv: x_d x x_e, track estimate, tau_FL.., "
              "mu_x true_mu_x.., vx vx_e..")
      .delimiter(',')
      .type_name("F,F...");
  plot.option("--arm", w.plot.arms, "only this arm or platform, or these")
      .delimiter(',')
      .type_name("ARM,ARM...");
  plot.option("--from", w.plot.from, "simulated time").type_name("S");
  plot.option("--to", w.plot.to, "simulated time").type_name("S");
  plot.option("--output", w.output, "PNG file (default RUN/plots/log-WHAT.png)").type_name("FILE");
  runs(plot, w, [&w](std::ostream& out, std::ostream& err) { return draw(w, out, err); });
}

void add_commands(CommandLine& line, Words& w) {
  CommandLine& show =
      line.subcommand("show", "Tell a run: a line per macrostep, change, order, refusal and message");
  add_run(show, w);
  show.option("--channel", w.show.channel, "every message of this channel instead").type_name("C");
  show.option("--from", w.show.from, "simulated time").type_name("S");
  show.option("--to", w.show.to, "simulated time").type_name("S");
  show.flag("--m", w.show.changes, "only what changes: behaviours, states, orders, faults, messages");
  runs(show, w, [&w](std::ostream& out, std::ostream& err) {
    w.show.json = w.json;
    if (w.show.from > w.show.to)
      throw FaultError(FaultCode::bad_usage,
                       fmt::format("--from {:g} is after --to {:g}", w.show.from, w.show.to),
                       "give the earlier time first");
    const RunRecord run(w.run);
    warn_of_damage(run, err);
    show_log(run, w.show, out, err);
    return 0;
  });
  CommandLine& csv =
      line.subcommand("csv", "Write a channel as a table; without a channel: list the channels");
  add_run(csv, w);
  csv.option("channel", w.what, "such as arm1.reply").type_name("CHANNEL");
  csv.option("--fields", w.fields, "only these, such as F_a,T_0E").delimiter(',').type_name("F,F...");
  csv.option("--output", w.output, "file instead of the standard output").type_name("FILE");
  runs(csv, w, [&w](std::ostream& out, std::ostream& err) { return write_table(w, out, err); });
  add_plot(line, w);
  CommandLine& compare = line.subcommand("compare", "Find the first message in which two runs differ");
  compare.option("a", w.run, "a run folder").required().type_name("A");
  compare.option("b", w.other, "another").required().type_name("B");
  runs(compare, w, [&w](std::ostream& out, std::ostream&) {
    return report_comparison(compare_runs(RunRecord(w.run), RunRecord(w.other)), w.json, out);
  });
  CommandLine& check_command = line.subcommand(
      "check",
      "Recompute from the log what agents and receptors decided, and name what differs; not drivers, "
      "simulator and cameras");
  check_command.option("run", w.runs, "run folders").required().type_name("RUN...");
  runs(check_command, w, [&w](std::ostream& out, std::ostream&) { return check(w, out); });
}

}  // namespace

std::vector<std::string> log_words() {
  std::vector<std::string> words{"show", "csv", "plot",     "compare", "check",    "--channel", "--from",
                                 "--to", "--m", "--fields", "--arm",   "--output", "--json"};
  std::ranges::move(plot_subjects(), std::back_inserter(words));
  return words;
}

int run_log(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  Words w;
  CommandLine line("What a run folder holds, whether it can be recomputed, and where two runs differ.",
                   "ui_cli log");
  line.take_one_subcommand(true);
  add_commands(line, w);
  line.footer(
      "Exit status: 0; 1 runs differ, or a log is not what its programs compute; 2 bad usage; 3 system "
      "error.");
  if (const auto status = line.parse_words(arguments, out, err, kExamples)) return *status;
  return w.command(out, err);
}

}  // namespace mrroc::ui
