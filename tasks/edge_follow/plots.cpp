#include "tasks/edge_follow/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tasks/edge_follow/edge_follow.hpp"

namespace mrroc::edge_follow {
namespace {

constexpr std::array kArms{"arm1", "arm2"};

/// A plate as the picture shows it: right of the arm, and away from it, measured from the sheet's centre [mm].
struct Plate {
  std::string shape;
  double length{}, width{}, distance{};
};

Plate read_plate(const Config& config, const std::string& arm) {
  const Config plate = config.section("robots." + arm).section("plate");
  return {.shape = plate.text("shape", "none"),
          .length = 1e3 * plate.number("length", 0.08, {0.01, 0.2}, "m"),
          .width = 1e3 * plate.number("width", 0.05, {0.01, 0.2}, "m"),
          .distance = 1e3 * plate.number("distance", 0.06, {-0.2, 0.2}, "m")};
}

std::string outline(const Plate& p) {
  const double x = p.length / 2, y = p.width / 2;
  std::string text;
  const auto point = [&](double right, double away) {
    text += fmt::format("{:.3f},{:.3f}\n", right, p.distance + away);
  };
  if (p.shape == "rectangle")
    for (const auto& [sx, sy] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}})
      point(sx * x, sy * y);
  if (p.shape == "ellipse")
    for (int k = 0; k <= 120; ++k) {
      const double angle = 2 * std::numbers::pi * k / 120;
      point(x * std::cos(angle), y * std::sin(angle));
    }
  return text.empty() ? "NaN,NaN\n" : text;
}

}  // namespace

std::string path_script(const Config& config) {
  constexpr int kWidth = 1200, kHeight = 600;
  const double radius = config.number("sim.pen_radius", 0.002, {0.0005, 0.02}, "m");
  const double centre = config.number("sim.paper.distance", 0.9, {0.7, 1.1}, "m");  // from the arm
  std::array<Plate, 2> plates;
  AxisRange right, away;  // the same for both arms: one scale
  std::string text = gnuplot_head("plots/path.png", kWidth, kHeight);
  for (std::size_t k = 0; k < kArms.size(); ++k) {
    plates[k] = read_plate(config, kArms[k]);
    text += fmt::format("$plate{} << EOD\n{}EOD\n", k + 1, outline(plates[k]));
    const double room = 2.5e3 * radius;  // [mm]
    for (const int side : {-1, 1}) {
      right.add(side * (plates[k].length / 2 + room));
      away.add(plates[k].distance + side * (plates[k].width / 2 + room));
    }
  }
  text += fmt::format(
      "followed(v) = column(3) == 2 ? v : NaN\nright(k) = -1e3*column(5)\naway(k) = 1e3*(column(4)-{:.6f})\n"
      "set multiplot layout 1,2 title 'edge\\_follow: way of the fingers around their plates, seen from "
      "above' "
      "font 'sans:Bold,15' textcolor rgb '#1b2a41'\n"
      "set size ratio -1\nset xrange {}\nset yrange {}\nset xlabel 'to the right [mm]'\nset ylabel 'away "
      "from the arm "
      "[mm]'\nset bmargin 7\nset key at graph 0.5, graph -0.2 center top horizontal reverse Left samplen 2 "
      "maxrows 1\n",
      centre, right.with_room(0, 0).text(), away.with_room(0, 0).text());
  for (std::size_t k = 0; k < kArms.size(); ++k) {
    text += fmt::format(
        "set title 'arm {0}: {1}' font 'sans:Bold,12'\nfirst = 1\n"
        "plot $plate{0} using 1:2 with filledcurves closed fc rgb '#d8dde5' title 'plate', \\\n"
        "  $plate{0} using 1:2 with lines lw 1 lc rgb '#667080' notitle, \\\n"
        "  'arm{0}.csv' skip 1 using (followed(right(1))):(followed(away(1))) with lines lw 2 lc rgb '{2}' "
        "title 'axis "
        "of the finger', \\\n"
        "  '' skip 1 using (column(3) == 2 && first ? (first = 0, right(1)) : NaN):(away(1)):({3:.3f}) with "
        "circles "
        "lw 1.5 lc rgb '{4}' fs transparent solid 0.15 border title 'finger at the beginning'\n",
        k + 1, plates[k].shape == "none" ? "no plate" : plates[k].shape, curve_colour(k), 1e3 * radius,
        kReferenceColour);
  }
  return text + "unset multiplot\n";
}

TimeChart force_chart(const Config& config) {
  const double desired = read_rule(config).force;
  TimeChart chart{.output = "", .title = "contact force over time"};
  for (std::size_t k = 0; k < kArms.size(); ++k) {
    ChartPanel panel{.title = fmt::format("arm {}, around its {}: force across the finger", k + 1,
                                          read_plate(config, kArms[k]).shape),
                     .y_label = "|F_{xy}| [N]"};
    panel.commands = "set yrange [0:*]\n";
    panel.curves = {
        {.source = fmt::format("{:g}", desired),
         .title = fmt::format("desired: {:g} N", desired),
         .colour = std::string(kReferenceColour),
         .style = CurveStyle::dashes,
         .width = 1.4},
        {.source = fmt::format("'arm{}.csv' skip 1 using 2:(sqrt(column(10)**2 + column(11)**2))", k + 1),
         .title = "measured",
         .colour = std::string(curve_colour(k)),
         .width = 1.2}};
    chart.panels.push_back(std::move(panel));
  }
  return chart;
}

}  // namespace mrroc::edge_follow
