#include "ui_cli/log/log_plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/fault.hpp"
#include "base/joined.hpp"
#include "base/text_file.hpp"
#include "base/time_chart.hpp"
#include "ui_cli/log/behaviour_names.hpp"
#include "ui_cli/log/platform_fields.hpp"
#include "ui_cli/subprocess.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

/// Data of a run and one of its arms or platforms.
struct Track {
  const RunRecord* run;
  std::unique_ptr<Readings> readings;
  BehaviourNames names;
};

/// An arm or a platform, and what each run that has it tells of it.
struct Arm {
  std::string key;
  std::vector<Track> tracks;
};

std::string name_of(const RunRecord& run) {
  const fs::path folder = fs::absolute(run.folder()).lexically_normal();
  return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
}

/// @return what a run is called beside the others: its folder's name, or the folder where that says too little
std::string legend_of(const std::vector<RunRecord>& runs, const RunRecord& run) {
  const auto same =
      std::ranges::count_if(runs, [&](const RunRecord& r) { return name_of(r) == name_of(run); });
  return gnuplot_literal(same > 1 ? run.folder().string() : name_of(run));
}

const char* name_of(Effector effector) { return effector == Effector::platform ? "platform" : "arm"; }

const std::vector<std::string>& subjects_of(Effector effector) {
  return effector == Effector::platform ? platform_subjects() : arm_subjects();
}

std::vector<std::string> keys_of(const RunRecord& run, Effector effector) {
  std::vector<std::string> keys = run.agents();
  std::erase_if(keys, [&](const std::string& key) { return run.effector_of(key) != effector; });
  return keys;
}

/// @return whether arms or platforms are drawn: those of which it can be drawn, and of both the arms
Effector drawn_of(const std::vector<RunRecord>& runs, const std::string& what) {
  const auto has = [&what](Effector e) {
    return what.empty() || std::ranges::find(subjects_of(e), what) != subjects_of(e).end();
  };
  const auto moves_none = [](const RunRecord& run) { return keys_of(run, Effector::arm).empty(); };
  if (!has(Effector::arm)) return Effector::platform;
  return has(Effector::platform) && std::ranges::all_of(runs, moves_none) ? Effector::platform
                                                                          : Effector::arm;
}

/// The run has nothing of the kind that is to be drawn. @throws FaultError bad_log
[[noreturn]] void refuse_run(const RunRecord& run, Effector effector) {
  const Effector other = effector == Effector::arm ? Effector::platform : Effector::arm;
  const std::vector<std::string> others = keys_of(run, other);
  throw FaultError(FaultCode::bad_log,
                   fmt::format("the log of {} tells of no {}", run.folder().string(), name_of(effector)),
                   others.empty() ? ""
                                  : fmt::format("of its {} {} there are {}", name_of(other),
                                                joined(others, ", "), joined(subjects_of(other), ", ")));
}

std::unique_ptr<Readings> read(const RunRecord& run, const std::string& key, Effector effector) {
  if (effector == Effector::platform) return std::make_unique<PlatformReadings>(run, key);
  return std::make_unique<ArmReadings>(run, key);
}

std::vector<Arm> arms_of(const std::vector<RunRecord>& runs, Effector effector,
                         const std::vector<std::string>& wanted) {
  std::vector<Arm> arms;
  for (const RunRecord& run : runs) {
    const std::vector<std::string> there = keys_of(run, effector);
    if (there.empty()) refuse_run(run, effector);
    for (const std::string& arm : wanted)
      if (std::ranges::find(there, arm) == there.end())
        throw FaultError(FaultCode::bad_usage,
                         fmt::format("{} has no {} '{}'", run.folder().string(), name_of(effector), arm),
                         fmt::format("{}s: {}", name_of(effector), joined(there, ", ")));
    for (const std::string& key : there) {
      if (!wanted.empty() && std::ranges::find(wanted, key) == wanted.end()) continue;
      auto arm = std::ranges::find(arms, key, &Arm::key);
      if (arm == arms.end()) arm = arms.insert(arms.end(), Arm{key, {}});
      arm->tracks.push_back({&run, read(run, key, effector), BehaviourNames(run)});
    }
  }
  return arms;
}

const std::string& label_of(const PlotField& field) {
  return field.legend.empty() ? field.name : field.legend;
}

/// @param alone  it is the only field on the axis
/// @return what the axis is of; of a platform the quantity: its fields are reference, true and estimated values of that
std::string axis_name(const PlotField& field, bool alone) {
  if (field.of_platform) return field.quantity;
  return alone ? label_of(field) : field.subject;
}

std::size_t axes_of(const Arm& arm) {
  std::size_t axes = 0;
  for (const Track& t : arm.tracks) axes = std::max(axes, t.readings->axes());
  return axes;
}

void check_times(const PlotOptions& o) {
  if (std::isnan(o.from) || std::isnan(o.to))
    throw FaultError(FaultCode::bad_usage, "--from and --to are seconds", "give numbers");
  if (o.from >= o.to)
    throw FaultError(FaultCode::bad_usage, fmt::format("--from {:g} is not before --to {:g}", o.from, o.to),
                     "give the earlier time first");
}

/// @return the time that there is to show
/// @throws FaultError  there is none
AxisRange times_of(const std::vector<Arm>& arms, const std::vector<PlotField>& fields, const PlotOptions& o) {
  AxisRange whole;
  for (const Arm& arm : arms)
    for (const Track& track : arm.tracks)
      for (const PlotField& f : fields) {
        const auto [first, last] = track.readings->extent(f);
        whole.add(first);
        whole.add(last);
      }
  if (whole.empty()) {
    std::vector<std::string> names;
    for (const PlotField& f : fields) names.push_back(f.name);
    throw FaultError(FaultCode::bad_log, fmt::format("the log has no readings of {}", joined(names, ", ")));
  }
  if (o.from >= whole.high || o.to <= whole.low)
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("there are no readings {}{}{}",
                                 std::isfinite(o.from) ? fmt::format("after {:g} s", o.from) : "",
                                 std::isfinite(o.from) && std::isfinite(o.to) ? " and " : "",
                                 std::isfinite(o.to) ? fmt::format("before {:g} s", o.to) : ""),
                     fmt::format("they are from {:g} to {:g} s", whole.low, whole.high));
  whole = {std::max(whole.low, o.from), std::min(whole.high, o.to)};
  if (whole.low == whole.high) whole.high += 1;  // of a single reading
  return whole;
}

/// A table with a line for the names of its columns, and empty lines where readings are missing.
std::string table(const std::string& name, const std::vector<std::string>& columns,
                  const std::vector<std::vector<Sample>>& samples, double macrostep_s) {
  constexpr double kGap = 10;  // macrosteps
  std::string text = fmt::format("${} << EOD\nt,{}\n", name, joined(columns, ","));
  for (std::size_t row = 0; row < samples.front().size(); ++row) {
    const double t = samples.front()[row].t;
    if (row > 0 && t - samples.front()[row - 1].t > kGap * macrostep_s) text += "\n";
    text += fmt::format("{:.6g}", t);
    for (const auto& column : samples) text += fmt::format(",{:.7g}", column[row].y);
    text += "\n";
  }
  return text + "EOD\n";
}

/// The picture while it is put together.
class Picture {
 public:
  Picture(const std::vector<RunRecord>& runs, AxisRange times) : runs_(runs) {
    chart_.from = times.low;
    chart_.to = times.high;
  }

  /// Adds a panel: a curve for each field of one run, or one field of each run.
  void add_panel(const Arm& arm, const std::vector<PlotField>& fields) {
    const PlotField& one = fields.front();
    ChartPanel panel;
    const std::string what = several() ? fmt::format("{}, {}", label_of(one), one.quantity) : one.quantity;
    panel.title = fmt::format("{}: {}", gnuplot_literal(arm.key), what);
    panel.y_label = axis_name(one, several() || fields.size() == 1);
    if (!one.unit.empty()) panel.y_label += fmt::format(" [{}]", one.unit);
    std::size_t colour = 0;
    for (const Track& track : arm.tracks) {
      const std::size_t run = static_cast<std::size_t>(track.run - runs_.data());
      std::vector<std::vector<Sample>> columns;
      std::vector<std::string> names;
      for (const PlotField& f : fields) {
        columns.push_back(track.readings->samples(f, chart_.from, chart_.to));
        names.push_back(f.name);
        for (const Sample& s : columns.back()) panel.y.add(s.y);
      }
      if (columns.front().empty()) continue;
      const std::string name = fmt::format("table{}", ++tables_);
      chart_.data += table(name, names, columns, track.run->macrostep_s());
      for (std::size_t k = 0; k < fields.size(); ++k)
        panel.curves.push_back(
            {.source = fmt::format("${} skip 1 using 1:{}", name, k + 2),
             .title = several() ? legend_of(runs_, *track.run) : label_of(fields[k]),
             .colour = std::string(curve_colour(several() ? run : colour++)),
             .style = one.source == FieldSource::behaviour ? CurveStyle::steps : CurveStyle::lines,
             .width = 1.4});
    }
    panel.y = panel.y.with_room();
    finish(arm, one, panel);
    chart_.panels.push_back(std::move(panel));
  }

  /// @return the picture @param what  it shows
  TimeChart finished(const std::string& what, const std::string& picture) {
    chart_.output = picture;
    chart_.title = several() ? fmt::format("{} of {} runs", what, runs_.size())
                             : fmt::format("{}: {}", gnuplot_literal(name_of(runs_.front())), what);
    if (several())
      chart_.notes.push_back("behaviours above the charts: those of " + legend_of(runs_, runs_.front()));
    if (const std::string tasks = tasks_to_name(); !tasks.empty())
      chart_.title = gnuplot_literal(tasks) + ", " + chart_.title;
    return std::move(chart_);
  }

 private:
  [[nodiscard]] bool several() const { return runs_.size() > 1; }

  /// @return the tasks of the runs, each once, in their order; empty for one that the names of all runs tell
  [[nodiscard]] std::string tasks_to_name() const {
    std::vector<std::string> tasks;
    bool told = true;
    for (const RunRecord& run : runs_) {
      if (run.task().empty()) continue;
      told = told && name_of(run).find(run.task()) != std::string::npos;
      if (std::ranges::find(tasks, run.task()) == tasks.end()) tasks.push_back(run.task());
    }
    return told && tasks.size() < 2 ? "" : joined(tasks, " and ");
  }

  /// Bands of behaviours, and what the title has to say of the readings.
  void finish(const Arm& arm, const PlotField& one, ChartPanel& panel) {
    const Track& first = arm.tracks.front();
    panel.bands = behaviour_bands(*first.run, first.names, arm.key);
    const double biased = first.readings->biased_at();
    if (one.source == FieldSource::force && biased > chart_.from && biased < chart_.to) {
      std::erase_if(panel.bands, [&](const TimeBand& b) { return b.to <= biased; });
      if (!panel.bands.empty()) panel.bands.front().from = std::max(panel.bands.front().from, biased);
      panel.bands.insert(panel.bands.begin(),
                         {.from = chart_.from, .to = biased, .m = 0, .name = "before the bias"});
    }
    if (one.source == FieldSource::behaviour) name_levels(panel);
  }

  /// Behaviours have names instead of numbers at the axis.
  void name_levels(ChartPanel& panel) {
    std::vector<std::string> tics{"'0 none' 0"};
    int most = 0;
    for (const TimeBand& band : panel.bands) {
      const std::string tic = fmt::format(
          "{} {}", gnuplot_quoted(gnuplot_literal(fmt::format("{} {}", band.m, band.name))), band.m);
      if (std::ranges::find(tics, tic) == tics.end()) tics.push_back(tic);
      most = std::max(most, band.m);
    }
    panel.y = {-0.5, most + 0.5};
    panel.height = std::clamp(22 * (most + 1), 120, 700);
    panel.commands += fmt::format("set ytics ({}) font 'sans,10'\n", joined(tics, ", "));
    panel.y_label = "";
    constexpr int kCharacter = 7, kTics = 30;  // [pixels]
    for (const std::string& tic : tics)
      chart_.left = std::max(chart_.left, kTics + kCharacter * static_cast<int>(tic.size()));
  }

  const std::vector<RunRecord>& runs_;
  TimeChart chart_;
  int tables_{};
};

}  // namespace

std::vector<std::string> plot_subjects() {
  std::vector<std::string> all = arm_subjects();
  for (const std::string& subject : platform_subjects())
    if (std::ranges::find(all, subject) == all.end()) all.push_back(subject);
  return all;
}

std::string plot_script(const std::vector<RunRecord>& runs, const PlotOptions& o,
                        const std::string& picture) {
  check_times(o);
  const Effector effector = drawn_of(runs, o.what);
  const std::vector<Arm> arms = arms_of(runs, effector, o.arms);
  std::size_t axes = 0;
  for (const Arm& arm : arms) axes = std::max(axes, axes_of(arm));
  const std::vector<PlotField> known =
      effector == Effector::platform ? platform_fields(o.what) : plot_fields(o.what, axes);
  const std::vector<PlotField> fields = chosen_fields(known, o.fields);
  if (fields.empty()) throw FaultError(FaultCode::bad_log, fmt::format("the log has nothing of {}", o.what));
  Picture to(runs, times_of(arms, fields, o));
  std::vector<std::string> quantities;
  for (const Arm& arm : arms) {
    std::vector<std::vector<PlotField>> panels;
    for (const PlotField& f : fields) {
      if (of_axis(f) && f.index >= axes_of(arm)) continue;
      if (panels.empty() || runs.size() > 1 || panels.back().front().quantity != f.quantity)
        panels.emplace_back();
      panels.back().push_back(f);
      if (quantities.empty() || quantities.back() != f.quantity) quantities.push_back(f.quantity);
    }
    for (const auto& panel : panels) to.add_panel(arm, panel);
  }
  std::ranges::sort(quantities);
  const bool one = std::ranges::adjacent_find(quantities, std::not_equal_to{}) == quantities.end();
  return time_chart_script(to.finished(one              ? quantities.front()
                                       : o.what.empty() ? "fields over time"
                                                        : o.what,
                                       picture));
}

fs::path plot_runs(const std::vector<RunRecord>& runs, const PlotOptions& o, const fs::path& output) {
  const std::string what = o.what.empty() ? "fields" : o.what;
  fs::path picture = fs::absolute(
      output.empty() ? runs.front().folder() / "plots" / fmt::format("log-{}.png", what) : output);
  if (picture.extension() != ".png")
    throw FaultError(FaultCode::bad_usage, fmt::format("{} is no name of a PNG picture", picture.string()),
                     "give it a name that ends in .png; the script beside it draws other formats");
  if (!output.empty() && !fs::is_directory(picture.parent_path()))
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("there is no folder {}", picture.parent_path().string()),
                     "make it, or give --output another name");
  fs::path script = picture;
  script.replace_extension(".gp");
  const std::string text = plot_script(runs, o, picture.filename().string());
  std::error_code ignored;
  fs::create_directories(picture.parent_path(), ignored);
  fs::remove(picture, ignored);  // one that is there afterwards is this one
  write_text_file(script, text);
  const Finished drawn = run_program("gnuplot", {script.filename().string()}, picture.parent_path());
  if (drawn.status == 0 && fs::exists(picture)) return picture;
  throw FaultError(
      FaultCode::cannot_write,
      drawn.status == -1 ? "gnuplot is not installed" : fmt::format("gnuplot ended with {}", drawn.status),
      drawn.status == -1 ? "apt-get install gnuplot-nox" : fmt::format("look at {}", script.string()));
}

}  // namespace mrroc::ui
