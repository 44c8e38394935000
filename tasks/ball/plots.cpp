#include "tasks/ball/plots.hpp"

#include <fmt/core.h>

#include "tasks/ball/figures.hpp"

namespace mrroc::ball {
namespace {

ChartCurve curve(int column, const char* title, std::size_t colour) {
  return {.source = fmt::format("$held using 1:{}", column),
          .title = title,
          .colour = std::string(curve_colour(colour)),
          .width = 1.2};
}

}  // namespace

std::string path_script(const std::vector<BodyRow>& rows) {
  const auto lifted = lifted_pose(rows);
  std::string points;
  AxisRange x, z;
  for (const BodyRow& row : rows) {
    if (!lifted || row.m < kLift || row.m > kLower) continue;
    const Vector3 way = 1e3 * (row.T_UO.p - lifted->p), led = 1e3 * (row.wanted + row.yielded);
    points += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}\n", led.x(), led.z(), way.x(), way.z());
    for (const Vector3& p : {way, led}) {
      x.add(p.x());
      z.add(p.z());
    }
  }
  constexpr double kRoom = 15;  // [mm]
  for (AxisRange* range : {&x, &z}) {
    range->add(range->low - kRoom);
    range->add(range->high + kRoom);
  }
  return gnuplot_head("plots/path.png", 900, 860) +
         fmt::format(
             "$way << EOD\n{}EOD\n"
             "set title 'ball: the way of the object, seen along the line between the palms' font "
             "'sans:Bold,15'\n"
             "set size ratio -1\nset xrange {}\nset yrange {}\nset xlabel 'x [mm]'\nset ylabel 'up [mm]'\n"
             "set key outside bottom center horizontal reverse Left samplen 2\n"
             "plot $way using 1:2 with lines lw 7 lc rgb '#d0d7e2' title 'where it is led', \\\n"
             "  '' using 3:4 with lines lw 1.5 lc rgb '{}' title 'object'\n",
             points, x.text(), z.text(), curve_colour(0));
}

TimeChart force_chart(const std::vector<BodyRow>& rows, const Parameters& k) {
  TimeChart chart{.output = "", .title = "inner force, and the object off where it is led"};
  const auto lifted = lifted_pose(rows);
  chart.data = "$held << EOD\n";
  for (const BodyRow& row : rows) {
    if (row.m < kSqueeze || row.m > kLower) continue;
    const double off =
        lifted && row.m >= kLift ? 1e3 * (row.T_UO.p - lifted->p - row.wanted - row.yielded).norm() : 0;
    chart.data += fmt::format("{:.2f},{:.3f},{:.3f},{:.3f},{:.3f}\n",
                              static_cast<double>(row.i) * kPacing.macrostep_s(), row.press[0], row.press[1],
                              off, k.force);
  }
  chart.data += "EOD\n";
  ChartPanel forces{.title = "normal force of the palms", .y_label = "F [N]"};
  forces.curves = {curve(5, "wanted", 2), curve(2, "arm1", 0), curve(3, "arm2", 1)};
  ChartPanel off{.title = "object off where it is led", .y_label = "[mm]"};
  off.curves = {curve(4, "", 0)};
  chart.panels = {forces, off};
  return chart;
}

}  // namespace mrroc::ball
