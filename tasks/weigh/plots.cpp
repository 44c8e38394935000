#include "tasks/weigh/plots.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "tasks/weigh/weigh.hpp"

namespace mrroc::weigh {
namespace {

constexpr int kFirstForce = 10;  // column of F_x in arm1.csv

/// Short lines at the mean values, over the time in which they were taken.
std::string mean_lines(const mp::ArmTrace& trace, int m, std::size_t first) {
  AxisRange times;
  for (const mp::ArmRow& row : trace)
    if (row.m == m) times.add(row.t);
  if (times.empty()) return "";
  std::string text;
  const Wrench mean = mean_reading(trace, m);
  for (std::size_t k = first; k < first + 3; ++k)
    text += fmt::format(
        "set arrow from first {0:.4f}, first {2:.6g} to first {1:.4f}, first {2:.6g} nohead lw 2 dt 2 lc "
        "rgb '{3}' front\n",
        times.low, times.high, mean.v[k], kReferenceColour);
  return text;
}

ChartPanel panel(const mp::ArmTrace& trace, const char* title, const char* y_label, char symbol,
                 std::size_t first) {
  ChartPanel p{.title = title, .y_label = y_label};
  for (std::size_t k = 0; k < 3; ++k)
    p.curves.push_back({.source = fmt::format("'arm1.csv' skip 1 using 2:{}", kFirstForce + first + k),
                        .title = fmt::format("{}_{}", symbol, "xyz"[k]),
                        .colour = std::string(curve_colour(k))});
  p.curves.push_back({.source = "NaN",
                      .title = "mean of the readings",
                      .colour = std::string(kReferenceColour),
                      .style = CurveStyle::dashes,
                      .width = 2});
  p.commands = mean_lines(trace, kWithToolUp, first) + mean_lines(trace, kWithToolSideways, first);
  return p;
}

}  // namespace

TimeChart forces_chart(const mp::ArmTrace& trace) {
  TimeChart chart{.output = "", .title = "what the tool weighs in three orientations"};
  chart.panels = {panel(trace, "force F_a in the wrist, zero with the tool down", "force [N]", 'F', 0),
                  panel(trace, "moment about the wrist's axes", "moment [N m]", 'N', 3)};
  const bool whole = std::ranges::any_of(trace, [](const mp::ArmRow& r) { return r.m == kWithToolSideways; });
  if (!whole) return chart;
  const ecp::ForceTool tool = found_tool(trace);
  chart.notes.push_back(
      fmt::format("found:  weight {:.2f} N,  mass centre ({:.1f}, {:.1f}, {:.1f}) mm in the wrist", tool.w,
                  1e3 * tool.P.x(), 1e3 * tool.P.y(), 1e3 * tool.P.z()));
  return chart;
}

}  // namespace mrroc::weigh
