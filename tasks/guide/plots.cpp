#include "tasks/guide/plots.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tasks/guide/figures.hpp"

namespace mrroc::guide {
namespace {

constexpr double kBetween = 0.0005;  // points of a drawn fixture [m]

/// The fixture in its plane [mm].
Points outline(const Fixture& fixture) {
  if (fixture.is_plane()) {
    const double x = 500 * fixture.sides()[0], y = 500 * fixture.sides()[1];
    return {{-x, -y}, {x, -y}, {x, y}, {-x, y}, {-x, -y}};
  }
  Points points;
  const Pose T_F0 = fixture.T_0F().inverse();
  std::ranges::transform(fixture.points(kBetween), std::back_inserter(points),
                         [&](const Vector3& p) { return Point(1e3 * (T_F0 * p).head<2>()); });
  return points;
}

/// Coordinates in the plane of the fixture as gnuplot computes them from arm1.csv.
std::string in_plane(const Fixture& fixture, int axis) {
  const Vector3 a = fixture.T_0F().R.col(axis), p = fixture.T_0F().p;
  return fmt::format(
      "1e3*(({:.9f})*(column(4)-({:.9f}))+({:.9f})*(column(5)-({:.9f}))+({:.9f})*(column(6)-({:.9f})))",
      a.x(), p.x(), a.y(), p.y(), a.z(), p.z());
}

ChartCurve curve(int column, const char* title, std::size_t colour) {
  return {.source = fmt::format("$led using 1:{}", column),
          .title = title,
          .colour = std::string(curve_colour(colour)),
          .width = 1.2};
}

}  // namespace

std::string fixture_script(const Setup& k) {
  std::string points;
  AxisRange x, y;
  for (const Point& p : outline(k.fixture)) {
    points += fmt::format("{:.3f},{:.3f}\n", p.x(), p.y());
    x.add(p.x());
    y.add(p.y());
  }
  const double room = 8 + 0.05 * std::max(x.high - x.low, y.high - y.low);  // [mm]
  for (const int side : {-1, 1}) {
    x.add((side < 0 ? x.low : x.high) + side * room);
    y.add((side < 0 ? y.low : y.high) + side * room);
  }
  // As high as the plot with equal axes needs, so that the legend stands right below it.
  const double share = (y.high - y.low) / (x.high - x.low);
  const int height = static_cast<int>(std::clamp(210 + 790 * share, 320.0, 900.0));
  return gnuplot_head("plots/fixture.png", 900, height) +
         fmt::format(
             "$fixture << EOD\n{0}EOD\n"
             "u(k) = {1}\nw(k) = {2}\nheld(v) = column(3) == {3} ? v : NaN\n"
             "taken(v) = column(3) == {4} || column(3) == {5} ? v : NaN\n"
             "set title 'guide: the fixture and the way of the tool, in the plane of the fixture' font "
             "'sans:Bold,15'\n"
             "set size ratio -1\nset xrange {6}\nset yrange {7}\nset xlabel 'x [mm]'\nset ylabel 'y [mm]'\n"
             "set bmargin 6\nset key outside bottom center horizontal reverse Left samplen 2\n"
             "plot $fixture using 1:2 with lines lw 7 lc rgb '#d0d7e2' title 'fixture', \\\n"
             "  'arm1.csv' skip 1 using (taken(u(1))):(taken(w(1))) with lines lw 3 lc rgb '{8}' title "
             "'tool while it "
             "enters and leaves', \\\n"
             "  '' skip 1 using (held(u(1))):(held(w(1))) with lines lw 1.5 lc rgb '{9}' title 'tool on the "
             "fixture'\n",
             points, in_plane(k.fixture, 0), in_plane(k.fixture, 1), kGuided, kEnter, kLeave, x.text(),
             y.text(), curve_colour(1), curve_colour(0));
}

TimeChart force_chart(const mp::ArmTrace& trace, const Setup& k) {
  TimeChart chart{.output = "",
                  .title = "forces that the operator feels, and how far he gets off the fixture"};
  chart.data = "$led << EOD\n";
  for (const LedRow& row : led_rows(trace, k))
    chart.data += fmt::format("{:.4f},{:.4f},{:.4f},{:.5f},{:.5f}\n", row.t, row.along, row.across,
                              1e3 * row.standing.off(),
                              1e3 * std::hypot(row.standing.beyond[0], row.standing.beyond[1]));
  chart.data += "EOD\n";
  ChartPanel forces{.title = "force of the tool on the hand", .y_label = "|F| [N]"};
  forces.curves = {curve(3, "across the fixture", 1), curve(2, "along it, and of its walls", 0)};
  ChartPanel off{.title = "place of the tool", .y_label = "[mm]"};
  off.curves = {curve(4, "off the fixture", 1), curve(5, "in a wall", 0)};
  chart.panels = {forces, off};
  return chart;
}

}  // namespace mrroc::guide
