#include "launch/evaluation.hpp"

#include <algorithm>
#include <tuple>

#include "mp/behaviour_bands.hpp"
#include "mp/print_line.hpp"
#include "mp/step_forces.hpp"

namespace mrroc::launch {
namespace {

/// @return the script of a picture, with the behaviours of the run
std::string script_of(const Results& r, const Evaluation& e, const std::vector<mp::ArmTrace>& traces,
                      const Picture& picture) {
  if (!picture.chart) return picture.script;
  TimeChart chart = *picture.chart;
  chart.output = "plots/" + picture.name + ".png";
  chart.title = gnuplot_literal(r.summary.task) + ": " + chart.title;
  if (!(chart.from < chart.to)) std::tie(chart.from, chart.to) = mp::times_of(traces);
  const auto name = [&](int m) {
    const auto number = static_cast<std::size_t>(m);
    return number >= 1 && number <= e.behaviours.size() ? e.behaviours[number - 1].name : "";
  };
  for (std::size_t k = 0; k < std::min(picture.arms.size(), chart.panels.size()); ++k)
    chart.panels[k].bands = mp::behaviour_bands(traces.at(picture.arms[k]), name);
  return time_chart_script(chart);
}

}  // namespace

void evaluate(const Evaluation& e, Results& r) {
  const Config& config = r.setup.config;
  std::vector<mp::ArmTrace> traces(r.coordinator.traces().begin(), r.coordinator.traces().end());
  const link::LogReader log(r.folder / "events.lcmlog");
  for (std::size_t arm = 0; arm < traces.size(); ++arm)
    mp::add_step_forces(traces[arm], log, r.arms[arm].key);
  for (const CellArm& arm : r.arms) r.columns.push_back(arm.key);
  if (e.figures)
    for (mp::TaskFigure& figure : e.figures(traces, config)) {
      r.known.push_back(figure.info);
      r.summary.figures.emplace(figure.info.key, std::move(figure.value));
    }
  if (e.result && !r.summary.fault) r.remarks = e.result(traces);
  const bool moved = std::ranges::any_of(traces, [](const mp::ArmTrace& trace) { return !trace.empty(); });
  if (!e.pictures || !moved) return;
  const std::vector<Picture> pictures = e.pictures(traces, config);
  if (pictures.empty()) mp::print_line("no pictures: the run ended before there was anything to draw");
  for (const Picture& p : pictures) r.pictures.emplace_back(p.name, script_of(r, e, traces, p));
}

}  // namespace mrroc::launch
