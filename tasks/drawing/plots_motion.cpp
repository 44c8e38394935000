// MS fig. 8, 9 and 10: the arms' motions over time.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tasks/drawing/plots_scripts.hpp"

namespace mrroc::drawing {
namespace {

constexpr std::array kArmNames{"arm 1 (postument)", "arm 2 (track)"};

bool teaching(const mp::ArmRow& row) { return row.m == 1 || row.m == 2; }
bool reproducing(const mp::ArmRow& row) { return row.m >= 3; }
bool copying(const mp::ArmRow& row) { return row.m >= 4; }
bool in_space(const mp::ArmRow& row) { return teaching(row) || copying(row); }

// Least and largest value over rows.
struct Span {
  double low{1e300}, high{-1e300};

  void add(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
  }
  [[nodiscard]] bool empty() const { return low > high; }
  [[nodiscard]] double size() const { return high - low; }
  // gnuplot's notation, with room at both ends
  [[nodiscard]] std::string with_room(double below, double above) const {
    if (empty()) return "[*:*]";
    return fmt::format("[{:.4f}:{:.4f}]", low - below * size() - 1e-3, high + above * size() + 1e-3);
  }
};

template <class Filter, class Value>
Span span_of(const RunTables& run, Filter filter, Value value) {
  Span span;
  for (std::size_t arm = 0; arm < 2; ++arm)
    if (run.arms[arm])
      for (const mp::ArmRow& row : *run.arms[arm])
        if (filter(row)) span.add(value(arm, row));
  return span;
}

bool has(const std::optional<mp::ArmTrace>& trace, bool (*filter)(const mp::ArmRow&)) {
  return trace && std::any_of(trace->begin(), trace->end(), filter);
}

// The four segments of one stroke, MS 8.4: on the paper (m = 5), lift-off (6), travel (7), lowering (4).
struct Segments {
  std::array<double, 5> t{};  // beginnings of the four, end of the last [s]
  double impact_t{};          // of the largest force while lowering [s]
  double impact_force{};      // [N]
};

std::optional<Segments> segments_from(const mp::ArmTrace& rows, std::size_t k) {
  Segments found;
  std::size_t part = 0;
  for (const int m : {5, 6, 7, 4}) {
    if (k >= rows.size() || rows[k].m != m) return std::nullopt;
    found.t[part++] = rows[k].t;
    for (; k < rows.size() && rows[k].m == m; ++k)
      if (m == 4 && rows[k].F[Axis::z] > found.impact_force) {
        found.impact_force = rows[k].F[Axis::z];
        found.impact_t = rows[k].t;
      }
  }
  found.t[part] = rows[k - 1].t;
  return found;
}

// The second complete four, as the first may be short of what is usual; the only one if there is no other.
std::optional<Segments> segments(const mp::ArmTrace& rows) {
  std::optional<Segments> first;
  for (std::size_t k = 1; k < rows.size(); ++k)
    if (rows[k].m == 5 && rows[k - 1].m != 5)
      if (const std::optional<Segments> found = segments_from(rows, k)) {
        if (first) return found;
        first = found;
      }
  return first;
}

std::string preamble(const std::string& name, int width, int height) {
  return fmt::format(R"(# Draws plots/{0}.png; run it in the run folder: gnuplot plots/{0}.gp
set terminal pngcairo size {1},{2} enhanced font 'sans,12' background rgb 'white' rounded
set output 'plots/{0}.png'
set datafile separator ','
set border 3 lw 1 lc rgb '#667080'
set tics nomirror out scale 0.6 textcolor rgb '#333a45'
set grid lw 1 lc rgb '#e4e8ee'
set key at graph 1, graph 1.04 right bottom horizontal maxrows 1 reverse Left samplen 2 textcolor rgb '#333a45'
taught(v) = column(3) == 1 || column(3) == 2 ? v : NaN
led(v) = column(3) == 3 ? v : NaN
copied(v) = column(3) >= 4 ? v : NaN
)",
                     name, width, height);
}

std::string heading(const std::string& text) {
  return fmt::format("title \"{}\" font 'sans:Bold,16' textcolor rgb '#1b2a41'", text);
}

std::string panel_title(const std::string& text) {
  return fmt::format("set title \"{}\" font 'sans,13' textcolor rgb '#333a45' offset 0,-0.4\n", text);
}

// At the left, which leaves room for the legend at the right.
std::string left_title(const std::string& text) {
  return fmt::format(
      "set label 99 \"{}\" at graph 0, graph 1.075 left font 'sans,12' textcolor rgb '#333a45'\n", text);
}

// One curve over time in every panel of fig. 9 or 10.
struct Curve {
  std::string name, title, label;
  std::array<std::string, 2> value;  // gnuplot expression, per arm
  std::string teach_note;            // behind the title of the teach-in
  std::string extra;                 // commands for both panels
  std::function<double(std::size_t arm, const mp::ArmRow&)> of;
};

// Each panel has the range of what it shows: nothing is cut, and quiet data are not drawn small beside others.
template <class Filter>
std::string ranges(const RunTables& run, Filter filter, const Curve& curve) {
  const Span t = span_of(run, filter, [](std::size_t, const mp::ArmRow& row) { return row.t; });
  return fmt::format("set xrange {}\nset yrange {}\n", t.with_room(0, 0),
                     span_of(run, filter, curve.of).with_room(0.05, 0.2));
}

std::string marks(const RunTables& run, bool impact) {
  const std::optional<Segments> found = run.arms[0] ? segments(*run.arms[0]) : std::nullopt;
  if (!found) return "";
  std::string text;
  for (const double t : found->t)
    text += fmt::format(
        "set arrow from {0:.3f}, graph 0 to {0:.3f}, graph 0.97 nohead dt 3 lw 1 lc rgb '#98a2b0'\n", t);
  for (std::size_t k = 0; k < 4; ++k)
    text += fmt::format(
        "set label '{}' at {:.3f}, graph 0.92 center font 'sans:Bold,12' textcolor rgb '#1b2a41'\n", k + 1,
        (found->t[k] + found->t[k + 1]) / 2);
  if (impact)
    text += fmt::format(
        "set label '*' at {:.3f}, {:.3f} center offset 0,0.5 font 'sans:Bold,18' textcolor rgb '#b3261e'\n",
        found->impact_t, found->impact_force);
  return text;
}

std::string teach_panel(const RunTables& run, const Curve& curve) {
  const auto taught = [](const mp::ArmRow& row) { return teaching(row); };
  RunTables first;
  first.arms[0] = run.arms[0];
  return left_title("teach-in: the operator leads arm 1" + curve.teach_note) + ranges(first, taught, curve) +
         fmt::format(
             "plot 'arm1.csv' skip 1 using 2:(taught({})) with lines lw 1.6 lc rgb '#1f5fa8' title '{}'\n",
             curve.value[0], kArmNames[0]);
}

// Arm 2 as a thin dark line on the broad light one of arm 1: both can be seen where they are the same.
std::string copy_panel(const RunTables& run, const Curve& curve, bool impact) {
  std::string s =
      left_title(std::string("reproduction: 1 on the paper, 2 lift-off, 3 travel, 4 lowering and settling") +
                 (impact ? ", * impact" : "")) +
      ranges(run, reproducing, curve) + marks(run, impact) + "plot ";
  for (std::size_t arm = 0; arm < 2; ++arm)
    if (has(run.arms[arm], copying))
      s += fmt::format(
          "'arm{0}.csv' skip 1 using 2:(led({1})) with lines lw 1.2 lc rgb '#b0b8c4' {2}, \\\n"
          "  '' skip 1 using 2:(copied({1})) with lines {3} title '{4}', \\\n  ",
          arm + 1, curve.value[arm], arm == 0 ? "title 'led to the start'" : "notitle",
          arm == 0 ? "lw 5 lc rgb '#9cc3ee'" : "lw 1.3 lc rgb '#c2410c'", arm == 0 ? "arm 1" : "arm 2");
  return s + "NaN notitle\n";
}

std::string time_script(const RunTables& run, const Curve& curve, bool impact) {
  const bool taught = has(run.arms[0], teaching);
  const bool copied = has(run.arms[0], copying) || has(run.arms[1], copying);
  if (!taught && !copied) return "";
  const bool two = taught && copied;
  std::string s = preamble(curve.name, 1400, two ? 860 : 500);
  s += fmt::format("set multiplot layout {},1 margins 0.06,0.975,{},{} spacing 0,0.13 {}\n", two ? 2 : 1,
                   two ? 0.075 : 0.13, two ? 0.895 : 0.82, heading(curve.title));
  s += fmt::format("set ylabel '{}'\nset xlabel 'simulated time t [s]' offset 0,0.4\n{}", curve.label,
                   curve.extra);
  if (taught) s += teach_panel(run, curve);
  if (copied) s += copy_panel(run, curve, impact);
  return s + "unset multiplot\n";
}

std::string relative(const char* column, double origin) {
  return fmt::format("({}-({:.6f}))*1000", column, origin);
}

// gnuplot's measure of the height of a 3-D picture; with equal x and y, z fills kHeight times their larger range.
constexpr double kHeight = 1.25;

// A round step that divides a range into about so many parts.
double tics(double range, int parts) {
  const double raw = range / parts;
  const double decade = std::pow(10, std::floor(std::log10(raw)));
  for (const double step : {1.0, 2.0, 5.0})
    if (raw <= step * decade) return step * decade;
  return 10 * decade;
}

std::string path_panel(const std::string& title, const std::string& filter, std::size_t arm,
                       const Vector3& sheet) {
  const std::string x = fmt::format("({}({}))", filter, relative("$4", sheet.x()));
  const std::string y = fmt::format("({}({}))", filter, relative("$5", sheet.y()));
  const std::string z = fmt::format("({}({}))", filter, relative("$6", sheet.z()));
  const std::string on_paper = fmt::format("({0} < 0.1 ? {0} : NaN)", z);
  return panel_title(title) +
         fmt::format(
             "splot 'arm{0}.csv' skip 1 using {1}:{2}:{3} with lines lw 1.2 lc rgb '#6f9fd8' title 'in the "
             "air', \\\n"
             "  '' skip 1 using {1}:{2}:{4} with lines lw 3 lc rgb '#1b2a41' title 'on the paper'\n",
             arm + 1, x, y, z, on_paper);
}

}  // namespace

std::string trajectory_script(const RunTables& run, const PlotSetup& setup) {
  std::vector<std::string> panels;
  if (has(run.arms[0], teaching)) panels.push_back(path_panel("teach-in", "taught", 0, setup.sheet[0]));
  for (std::size_t arm = 0; arm < 2; ++arm)
    if (has(run.arms[arm], copying))
      panels.push_back(
          path_panel(fmt::format("reproduction, {}", kArmNames[arm]), "copied", arm, setup.sheet[arm]));
  if (panels.empty()) return "";
  const auto along = [&](int axis) {
    return span_of(run, in_space, [&](std::size_t arm, const mp::ArmRow& row) {
      return 1e3 * (row.pose[axis] - setup.sheet[arm][axis]);
    });
  };
  const Span x = along(0), y = along(1), z = along(2);
  const double width = std::max(x.size(), y.size()) * 1.16 + 2e-3;
  const double low = std::min(-0.5, 1.05 * z.low);
  const double high = std::max(5.0, 1.05 * z.high);
  std::string s = preamble("fig8_trajectory", 640 * static_cast<int>(panels.size()), 640);
  s += fmt::format("set multiplot layout 1,{} {}\n", panels.size(),
                   heading("MS fig. 8: trajectory of the pen"));
  s += fmt::format(R"(set border 31
set view 60,32,1.1,{}
set view equal xy
set xyplane at 0
set xlabel 'x [mm]' offset 0,-0.3
set ylabel 'y [mm]' offset 3,-0.3
set zlabel 'z [mm], drawn {:.2g} x as large' rotate by 90 offset 1,0
set key at screen 0.01,{} left top vertical maxrows 2
set tics scale 0.4 offset 0,-0.2
set ztics {} offset 0.5,0
)",
                   kHeight, kHeight * width / (high - low), panels.size() > 1 ? 0.97 : 0.92,
                   tics(high - low, 4));
  s += fmt::format(
      "set xtics {0}\nset ytics {0}\nset xrange {1}\nset yrange {2}\nset zrange [{3:.3f}:{4:.3f}]\n",
      tics(width, 6), x.with_room(0.08, 0.08), y.with_room(0.08, 0.08), low, high);
  for (const std::string& panel : panels) s += panel + "unset key\n";
  return s + "unset multiplot\n";
}

std::string height_script(const RunTables& run, const PlotSetup& setup) {
  Curve curve{"fig9_height", "MS fig. 9: height of the pen above the paper", "z [mm]", {}, "", "", {}};
  curve.value = {relative("$6", setup.sheet[0].z()), relative("$6", setup.sheet[1].z())};
  curve.of = [&](std::size_t arm, const mp::ArmRow& row) {
    return 1e3 * (row.pose.z() - setup.sheet[arm].z());
  };
  return time_script(run, curve, false);
}

std::string force_script(const RunTables& run) {
  Curve curve{"fig10_force", "MS fig. 10: vertical force that the pen exerts", "F_z [N]", {}, "", "", {}};
  curve.value = {"$12", "$12"};
  curve.teach_note = "; force measured at the pen, incl. the hand's pull";
  curve.extra =
      "set arrow from graph 0, first 1 to graph 1, first 1 nohead dt 2 lw 1 lc rgb '#b3261e' back\n"
      "set label '1 N' at graph 1, first 1 left offset 0.3,0 font 'sans,10' textcolor rgb '#b3261e'\n";
  curve.of = [](std::size_t, const mp::ArmRow& row) { return row.F[Axis::z]; };
  return time_script(run, curve, true);
}

}  // namespace mrroc::drawing
