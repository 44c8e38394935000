#include "tasks/rex_drive/plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/time_chart.hpp"
#include "tasks/rex_drive/path_plot.hpp"

namespace mrroc::rex_drive {
namespace {

std::string of_drive(const std::string& columns) { return "'platform.csv' skip 1 using " + columns; }

ChartCurve curve(const std::string& source, const char* title, std::size_t colour) {
  return {.source = source, .title = title, .colour = std::string(curve_colour(colour))};
}

/// The plan that is under way, and before and after none.
std::vector<TimeBand> bands_of(const DriveResults& r) {
  std::vector<TimeBand> bands;
  const std::vector<Stay> times = stays(r.fragments, r.table);
  for (std::size_t k = 0; k < times.size(); ++k) {
    if (!std::isfinite(times[k].begun) || !std::isfinite(times[k].ended)) continue;
    const std::string plan = fmt::format("plan {}", r.fragments[k].plan);
    if (bands.empty() || bands.back().name != plan)
      bands.push_back({.from = times[k].begun, .to = times[k].ended, .name = plan});
    bands.back().to = times[k].ended;
  }
  return bands;
}

TimeChart chart(const DriveResults& r, const std::string& name, const std::string& title) {
  TimeChart c{.output = "plots/" + name + ".png", .title = title};
  c.from = r.table.front().t;
  c.to = r.table.back().t > c.from ? r.table.back().t : c.from + 1;
  return c;
}

ChartPanel panel(const DriveResults& r, const char* title, const char* y_label) {
  return {.title = title, .y_label = y_label, .bands = bands_of(r)};
}

std::string error_script(const DriveResults& r) {
  TimeChart c = chart(r, "error", "Rex: errors of the true place");
  c.panels = {panel(r, "from the reference and from the estimate", "distance [mm]"),
              panel(r, "speed", "v [m/s]")};
  c.panels[0].curves = {curve(of_drive(fmt::format("1:{}", +column::track)), "reference", 0),
                        curve(of_drive(fmt::format("1:{}", +column::estimate)), "estimate", 1)};
  c.panels[0].commands = "set yrange [0:*]\n";
  c.panels[1].curves = {curve(of_drive(fmt::format("1:{}", +column::v_x)), "", 2)};
  return time_chart_script(c);
}

std::string slip_script(const DriveResults& r) {
  constexpr std::array kNames{"friction along the wheels", "friction across them", "split left and right"};
  constexpr std::array kSymbols{"{/Symbol m}_x", "{/Symbol m}_y", "split"};
  TimeChart c = chart(r, "slip", "Rex: slip coefficients, estimated with 2 standard deviations, and true");
  for (int k = 0; k < 3; ++k) {
    const auto n = static_cast<std::size_t>(k);
    ChartPanel p = panel(r, kNames[n], kSymbols[n]);
    ChartCurve above = curve(
        of_drive(fmt::format("1:(column({})+2*column({}))", column::mu_x + k, column::sd_mu_x + k)), "", 0);
    ChartCurve below = curve(
        of_drive(fmt::format("1:(column({})-2*column({}))", column::mu_x + k, column::sd_mu_x + k)), "", 0);
    above.style = below.style = CurveStyle::dashes;
    above.width = below.width = 0.8;
    p.curves = {above, below, curve(of_drive(fmt::format("1:{}", column::true_mu_x + k)), "true", 1),
                curve(of_drive(fmt::format("1:{}", column::mu_x + k)), "estimated", 0)};
    if (k < 2) p.commands = "set yrange [0:*]\n";
    c.panels.push_back(p);
  }
  return time_chart_script(c);
}

std::string torques_script(const DriveResults& r) {
  constexpr std::array kWheelNames{"front left", "front right", "rear left", "rear right"};
  TimeChart c = chart(r, "torques", "Rex: torques and loads of the wheels");
  c.panels = {panel(r, "commanded torque", "{/Symbol t} [N m]"), panel(r, "true load", "N [N]")};
  for (std::size_t wheel = 0; wheel < kWheels; ++wheel) {
    const auto n = static_cast<int>(wheel);
    c.panels[0].curves.push_back(
        curve(of_drive(fmt::format("1:{}", column::tau + n)), kWheelNames[wheel], wheel));
    c.panels[1].curves.push_back(
        curve(of_drive(fmt::format("1:{}", column::load + n)), kWheelNames[wheel], wheel));
  }
  return time_chart_script(c);
}

std::string odometry_script(const DriveResults& r) {
  const auto of_pairs = [](int column, const char* title, std::size_t colour) {
    return curve(fmt::format("'odometry.csv' skip 1 using 1:{}", column), title, colour);
  };
  TimeChart c = chart(r, "odometry", "Rex: visual odometry, from one pair of pictures to the next");
  c.panels = {panel(r, "points", "number"), panel(r, "error of the place", "distance [mm]"),
              panel(r, "error of the turn", "angle [mrad]")};
  c.panels[0].curves = {of_pairs(odometry_column::features, "corners", 3),
                        of_pairs(odometry_column::matches, "found in all four pictures", 1),
                        of_pairs(odometry_column::inliers, "that agree on the motion", 0)};
  c.panels[1].curves = {of_pairs(odometry_column::error, "true", 0),
                        of_pairs(odometry_column::sd, "standard deviation, as told", 1)};
  c.panels[2].curves = {of_pairs(odometry_column::turn_error, "true", 0),
                        of_pairs(odometry_column::turn_sd, "standard deviation, as told", 1)};
  for (ChartPanel& p : c.panels) p.commands = "set yrange [0:*]\n";
  if (std::ranges::none_of(r.odometry, &OdometryRow::valid))
    c.panels.resize(1);  // gnuplot draws no empty curves
  return time_chart_script(c);
}

std::string handover_script(const DriveResults& r) {
  const std::string file = "'fragments.csv' skip 1 using ";
  const auto points = [&](const char* columns, const char* title, std::size_t colour) {
    ChartCurve p = curve(file + columns, title, colour);
    p.style = CurveStyle::points;
    return p;
  };
  TimeChart c = chart(r, "handover", "Rex: fragments, when they are handed over and executed");
  c.panels = {panel(r, "number of the fragment", "fragment"),
              panel(r, "length of the fragment, and when it asks for the next one", "iterations"),
              panel(r, "speed, and at the ends of fragments", "v [m/s]")};
  c.panels[0].curves = {points("5:1", "handed over", 1), points("6:1", "begun", 0),
                        points("10:1", "notify: ready for the next", 3)};
  c.panels[1].curves = {points("6:3", "steps", 0), points("6:4", "notify", 3)};
  c.panels[2].curves = {curve(of_drive(fmt::format("1:{}", +column::v_x)), "true", 2),
                        points("7:8", "planned at the end", 1)};
  if (r.acked_in > 0)
    c.panels[0].marks = {{.letter = "a",
                          .t = static_cast<double>(r.acked_in) * kPlatformPeriod,
                          .y = static_cast<double>(r.fragments.size()),
                          .words = "last ack"}};
  return time_chart_script(c);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots(const DriveResults& results) {
  std::vector<std::pair<std::string, std::string>> scripts{{"path", path_script(results)},
                                                           {"error", error_script(results)},
                                                           {"slip", slip_script(results)},
                                                           {"torques", torques_script(results)}};
  if (!results.odometry.empty()) scripts.emplace_back("odometry", odometry_script(results));
  if (!results.fragments.empty()) scripts.emplace_back("handover", handover_script(results));
  return scripts;
}

}  // namespace mrroc::rex_drive
