#include "tasks/calibrate_cell/plots.hpp"

#include <fmt/core.h>

#include "base/gnuplot_text.hpp"

namespace mrroc::calibrate_cell {

std::string balls_script(const Calibration& found, const Bases& believed) {
  constexpr int kWidth = 1200, kHeight = 560;
  std::string text = gnuplot_head("plots/balls.png", kWidth, kHeight) + "$balls << EOD\n";
  const Pose T_U2 = believed[0] * found.T_12.T_AB;
  AxisRange x, y;
  for (std::size_t k = 0; k < found.balls[0].size(); ++k) {
    const Vector3 first = believed[0] * found.balls[0][k].centre;
    const Vector3 before = believed[1] * found.balls[1][k].centre;
    const Vector3 after = T_U2 * found.balls[1][k].centre;
    for (const Vector3& p : {first, before, after}) {
      x.add(1e3 * p.x());
      y.add(1e3 * p.y());
    }
    text += fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f}\n", k + 1,
                        1e3 * first.x(), 1e3 * first.y(), 1e3 * before.x(), 1e3 * before.y(), 1e3 * after.x(),
                        1e3 * after.y(), 1e3 * (before - first).norm(), 1e3 * found.T_12.residuals[k]);
  }
  return text +
         fmt::format(
             "EOD\nset multiplot layout 1,2 title 'calibrate\\_cell: balls that both arms touched' font "
             "'sans:Bold,15' textcolor rgb '#1b2a41'\nset bmargin 7\n"
             "set key at graph 0.5, graph -0.2 center top horizontal reverse Left samplen 2\n"
             "set title 'in the world, seen from above' font 'sans:Bold,12'\nset xlabel 'x [mm]'\nset ylabel "
             "'y [mm]'\n"
             "set xrange {0}\nset yrange {1}\n"
             "plot $balls using 2:3 with points pt 6 ps 3 lw 2 lc rgb '{2}' title 'arm1', \\\n"
             "  '' using 4:5 with points pt 2 ps 1.5 lw 2 lc rgb '{3}' title 'arm2, base as believed', \\\n"
             "  '' using 6:7 with points pt 7 ps 1 lc rgb '{4}' title 'arm2, base as found'\n"
             "set title 'between where both arms found a ball' font 'sans:Bold,12'\nset xlabel 'ball'\nset "
             "ylabel "
             "'[mm]'\nset xrange [0.5:{5}.5]\nset xtics 1\nset yrange [1e-3:*]\nset logscale y\n"
             "plot $balls using 1:8 with linespoints pt 2 ps 1.5 lw 2 lc rgb '{3}' title 'base as believed', "
             "\\\n"
             "  '' using 1:9 with linespoints pt 7 lw 2 lc rgb '{4}' title 'base as found'\nunset "
             "multiplot\n",
             x.with_room(0.2, 0.2).text(), y.with_room(0.2, 0.2).text(), curve_colour(0), curve_colour(1),
             curve_colour(2), found.balls[0].size());
}

}  // namespace mrroc::calibrate_cell
