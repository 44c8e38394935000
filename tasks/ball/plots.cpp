#include "tasks/ball/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "tasks/ball/ball.hpp"

namespace mrroc::ball {
namespace {

ChartCurve curve(int column, const char* title, std::size_t colour, double width = 1.2) {
  return {.source = fmt::format("$held using 1:{}", column),
          .title = title,
          .colour = std::string(curve_colour(colour)),
          .width = width};
}

/// @return where the object was when the palms began to lift; nothing: they have not. An object that stays on its pedestal
///         stays there in the picture, too
std::optional<Vector3> origin(const std::vector<BodyRow>& rows) {
  const auto first = std::ranges::find(rows, kLift, &BodyRow::m);
  if (first == rows.end()) return {};
  return first->T_UO.p - first->wanted - first->yielded;
}

}  // namespace

std::string path_script(const std::vector<BodyRow>& rows) {
  const auto from = origin(rows);
  std::string points;
  AxisRange x, z;
  int count = 0;
  for (const BodyRow& row : rows) {
    if (!from || row.m < kLift || row.m > kLower) continue;
    const Vector3 way = 1e3 * (row.T_UO.p - *from), led = 1e3 * (row.wanted + row.yielded);
    points += fmt::format("{:.3f},{:.3f},{:.3f},{:.3f}\n", led.x(), led.z(), way.x(), way.z());
    ++count;
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
             "$way << EOD\n{0}EOD\n"
             "set title 'ball: the way of the object, seen along the line between the palms' font "
             "'sans:Bold,15'\n"
             "set size ratio -1\nset xrange {1}\nset yrange {2}\nset xlabel 'x [mm]'\nset ylabel 'up [mm]'\n"
             "set bmargin 6\nset key outside bottom center horizontal reverse Left samplen 2\n"
             "plot $way using 1:2 with lines lw 7 lc rgb '#d0d7e2' title 'where it is led', \\\n"
             "  '' using 3:4 with lines lw 2 lc rgb '{3}' title 'object', \\\n"
             "  '' using 3:4 every ::{4}::{4} with points pt 7 ps 2 lc rgb '{3}' title 'its end', \\\n"
             "  '' using 1:2 every ::{4}::{4} with points pt 6 ps 3 lw 2 lc rgb '#7a8699' title 'wanted "
             "end'\n",
             points, x.text(), z.text(), curve_colour(0), std::max(count, 1) - 1);
}

TimeChart force_chart(const std::vector<BodyRow>& rows, const Parameters& k) {
  TimeChart chart{.output = "", .title = "inner force, and the object off where it is led"};
  const auto from = origin(rows);
  chart.data = "$held << EOD\n";
  for (const BodyRow& row : rows) {
    if (row.m < kSqueeze || row.m > kLower) continue;
    const double off =
        from && row.m >= kLift ? 1e3 * (row.T_UO.p - *from - row.wanted - row.yielded).norm() : 0;
    chart.data += fmt::format("{:.2f},{:.3f},{:.3f},{:.3f},{:.3f}\n",
                              static_cast<double>(row.i) * kPacing.macrostep_s(), row.press[0], row.press[1],
                              off, k.force);
  }
  chart.data += "EOD\n";
  ChartPanel forces{.title = "normal force of the palms", .y_label = "F [N]"};
  forces.curves = {curve(5, "wanted", 2), curve(2, "arm1", 0, 4), curve(3, "arm2", 1)};
  ChartPanel off{.title = "object off where it is led", .y_label = "[mm]"};
  off.curves = {curve(4, "", 0)};
  chart.panels = {forces, off};
  return chart;
}

}  // namespace mrroc::ball
