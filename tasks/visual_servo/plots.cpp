#include "tasks/visual_servo/plots.hpp"

#include <fmt/core.h>

#include <array>

#include "base/time_chart.hpp"

namespace mrroc::visual_servo {
namespace {

/// By their numbers in servo.csv.
constexpr std::array kNames{"no camera sees", "PB-SAC", "PB-EIH", "PB-SAC and EIH", "PB from memory"};

std::vector<TimeBand> bands_of(const ServoTable& table) {
  constexpr int kLeftOut = -1;  // also "no camera sees" is a band
  const auto number = [](const ServoRow& row) {
    return row.behaviour >= 0 && row.behaviour < static_cast<int>(kNames.size()) ? row.behaviour : kLeftOut;
  };
  const auto name = [](int m) { return kNames[static_cast<std::size_t>(m)]; };
  return time_bands(
      table, [](const ServoRow& row) { return row.t; }, number, name, kLeftOut);
}

TimeChart chart(const ServoTable& table, const std::string& name, const std::string& title) {
  TimeChart c{.output = "plots/" + name + ".png", .title = title};
  c.from = table.front().t;
  c.to = table.back().t > c.from ? table.back().t : c.from + 1;
  return c;
}

/// The norm of the error's position, while a behaviour that has one is active, in its colour.
ChartPanel error_panel(const ServoTable& table, const char* title, bool logarithmic) {
  ChartPanel p{.title = title, .y_label = "error [mm]"};
  p.bands = bands_of(table);
  for (std::size_t b = 1; b < kNames.size(); ++b)
    p.curves.push_back({.source = fmt::format("'servo.csv' skip 1 using 2:(column(3) == {} ? "
                                              "1e3*sqrt(column(6)**2 + column(7)**2 + column(8)**2) : NaN)",
                                              b),
                        .title = kNames[b],
                        .colour = std::string(curve_colour(b - 1)),
                        .style = CurveStyle::points,
                        .width = 0.7});
  p.commands = logarithmic ? "set logscale y\nset format y '%g'\n" : "set yrange [0:*]\n";
  return p;
}

ChartPanel truth_panel(const ServoTable& table, const char* title, const char* y_label, int column,
                       std::size_t colour) {
  ChartPanel p{.title = title, .y_label = y_label};
  p.bands = bands_of(table);
  p.curves = {{.source = fmt::format("'servo.csv' skip 1 using 2:{}", column),
               .colour = std::string(curve_colour(colour))}};
  p.commands = "set logscale y\nset format y '%g'\n";
  return p;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots(const ServoTable& table) {
  TimeChart error = chart(table, "error", "visual servo: error that the cameras see (VS fig. 28)");
  error.panels = {error_panel(table, "position", false), error_panel(table, "position, logarithmic", true)};
  TimeChart truth = chart(table, "true_error", "visual servo: true error of the tool");
  truth.panels = {truth_panel(table, "position", "error [mm]", 10, 0),
                  truth_panel(table, "orientation", "error [deg]", 11, 1)};
  return {{"error", time_chart_script(error)}, {"true_error", time_chart_script(truth)}};
}

}  // namespace mrroc::visual_servo
