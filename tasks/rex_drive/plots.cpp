#include "tasks/rex_drive/plots.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

#include "base/time_chart.hpp"

namespace mrroc::rex_drive {
namespace {

/// Columns of platform.csv.
enum Column : int {
  x_d = 2,
  x = 5,
  v_x = 8,
  x_e = 11,
  mu_x = 18,
  sd_mu_x = 21,
  true_mu_x = 24,
  tau = 27,
  load = 31,
  track = 35,
  estimate = 36
};

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
    const auto plan = static_cast<int>(r.fragments[k].plan);
    if (bands.empty() || bands.back().m != plan)
      bands.push_back({times[k].begun, times[k].ended, plan, fmt::format("plan {}", plan)});
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
  c.panels[0].curves = {curve(of_drive(fmt::format("1:{}", +track)), "reference", 0),
                        curve(of_drive(fmt::format("1:{}", +estimate)), "estimate", 1)};
  c.panels[0].commands = "set yrange [0:*]\n";
  c.panels[1].curves = {curve(of_drive(fmt::format("1:{}", +v_x)), "", 2)};
  return time_chart_script(c);
}

std::string slip_script(const DriveResults& r) {
  constexpr std::array kNames{"friction along the wheels", "friction across them", "split left and right"};
  constexpr std::array kSymbols{"{/Symbol m}_x", "{/Symbol m}_y", "split"};
  TimeChart c = chart(r, "slip", "Rex: slip coefficients, estimated with 2 standard deviations, and true");
  for (int k = 0; k < 3; ++k) {
    const auto n = static_cast<std::size_t>(k);
    ChartPanel p = panel(r, kNames[n], kSymbols[n]);
    ChartCurve above =
        curve(of_drive(fmt::format("1:(column({})+2*column({}))", mu_x + k, sd_mu_x + k)), "", 0);
    ChartCurve below =
        curve(of_drive(fmt::format("1:(column({})-2*column({}))", mu_x + k, sd_mu_x + k)), "", 0);
    above.style = below.style = CurveStyle::dashes;
    above.width = below.width = 0.8;
    p.curves = {above, below, curve(of_drive(fmt::format("1:{}", true_mu_x + k)), "true", 1),
                curve(of_drive(fmt::format("1:{}", mu_x + k)), "estimated", 0)};
    p.commands = k < 2 ? "set yrange [0:1.2]\n" : "set yrange [-0.8:0.8]\n";
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
    c.panels[0].curves.push_back(curve(of_drive(fmt::format("1:{}", tau + n)), kWheelNames[wheel], wheel));
    c.panels[1].curves.push_back(curve(of_drive(fmt::format("1:{}", load + n)), kWheelNames[wheel], wheel));
  }
  return time_chart_script(c);
}

std::string handover_script(const DriveResults& r) {
  const std::string file = "'fragments.csv' skip 1 using ";
  TimeChart c = chart(r, "handover", "Rex: fragments, when they are handed over and executed");
  c.panels = {panel(r, "number of the fragment", "fragment"),
              panel(r, "speed, and at the ends of fragments", "v [m/s]")};
  ChartCurve handed = curve(file + "5:1", "handed over", 1), begun = curve(file + "6:1", "begun", 0);
  handed.style = begun.style = CurveStyle::points;
  ChartCurve planned = curve(file + "7:8", "planned at the end", 1);
  planned.style = CurveStyle::points;
  c.panels[0].curves = {handed, begun};
  c.panels[1].curves = {curve(of_drive(fmt::format("1:{}", +v_x)), "true", 2), planned};
  if (r.acked_in > 0)
    c.panels[0].marks = {{.letter = "a",
                          .t = static_cast<double>(r.acked_in) * kPlatformPeriod,
                          .y = static_cast<double>(r.fragments.size()),
                          .words = "last ack"}};
  return time_chart_script(c);
}

/// 95 % ellipses of the estimate, ten times as large, one per second.
std::string ellipses(const DriveTable& table) {
  constexpr double kRadius = 2.4477, kLarger = 10;  // of 95 % in a plane
  constexpr int kEvery = 50, kCorners = 24;
  std::string data = "$ellipses << EOD\n";
  for (std::size_t k = 0; k < table.size(); k += kEvery) {
    const PlatformEstimate& e = table[k].estimate;
    const double a = e.covariance[0], b = e.covariance[1], d = e.covariance[4];
    if (!(a > 0) || !(a * d > b * b)) continue;
    const double l11 = std::sqrt(a), l21 = b / l11, l22 = std::sqrt(d - l21 * l21);
    for (int corner = 0; corner <= kCorners; ++corner) {
      const double s = 2 * std::numbers::pi * corner / kCorners;
      const double u = kLarger * kRadius * std::cos(s), w = kLarger * kRadius * std::sin(s);
      data += fmt::format("{:.4f},{:.4f}\n", e.p.x + l11 * u, e.p.y + l21 * u + l22 * w);
    }
    data += "\n";
  }
  return data + "NaN,NaN\nEOD\n";
}

std::string plan_points(const std::vector<Plan>& plans) {
  std::string data = "$plan << EOD\n";
  for (const Plan& plan : plans)
    for (std::int32_t k = 0; k < plan.n; ++k) {
      const auto& [px, py] = plan.point[static_cast<std::size_t>(k)];
      data += fmt::format("{:.4f},{:.4f}\n", px, py);
    }
  return data + "NaN,NaN\nEOD\n";
}

std::string path_script(const DriveResults& r) {
  std::string s = gnuplot_head("plots/path.png", 1100, 800);
  s += ellipses(r.table) + plan_points(r.plans);
  s += "set title \"Rex: plan, reference, true and estimated way; 95 % ellipses of the estimate, times 10\"\n"
       "set size ratio -1\nset xlabel 'x [m]'\nset ylabel 'y [m]'\nset key below\nplot ";
  s += fmt::format(
      "'platform.csv' skip 1 using {}:{} with lines lw 4 lc rgb '#c3cad4' title 'reference', \\\n", +x_d,
      x_d + 1);
  s += fmt::format("'platform.csv' skip 1 using {}:{} with lines lw 1.6 lc rgb '{}' title 'true', \\\n", +x,
                   x + 1, curve_colour(0));
  s += fmt::format("'platform.csv' skip 1 using {}:{} with lines lw 1 lc rgb '{}' title 'estimate', \\\n",
                   +x_e, x_e + 1, curve_colour(1));
  s += fmt::format("$ellipses using 1:2 with lines lw 0.8 lc rgb '{}' title '95 % ellipse, times 10', \\\n",
                   curve_colour(1));
  s += fmt::format("$plan using 1:2 with points pt 7 ps 0.9 lc rgb '{}' title 'plan'\n", kReferenceColour);
  return s;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> plots(const DriveResults& results) {
  return {{"path", path_script(results)},
          {"error", error_script(results)},
          {"slip", slip_script(results)},
          {"torques", torques_script(results)},
          {"handover", handover_script(results)}};
}

}  // namespace mrroc::rex_drive
