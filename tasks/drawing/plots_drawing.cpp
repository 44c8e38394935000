// The input drawing, the taught ink and both copies.
#include <fmt/core.h>

#include <algorithm>
#include <iterator>

#include "tasks/drawing/plots_scripts.hpp"
#include "tasks/drawing/strokes.hpp"

namespace mrroc::drawing {
namespace {

// One set of strokes as data inside the script: a blank line lifts the pen. A dot is drawn as a point.
std::string data(const std::string& name, const std::optional<Ink>& ink) {
  std::string lines = fmt::format("${} << EOD\n", name);
  std::string dots = fmt::format("${}_dots << EOD\n", name);
  for (const Stroke& stroke : strokes_of(ink.value_or(Ink{}))) {
    std::string& block = stroke.size() == 1 ? dots : lines;
    for (const Point& p : stroke) block += fmt::format("{:.3f} {:.3f}\n", p.x(), p.y());
    block += "\n";
  }
  // gnuplot warns about data blocks without a point.
  return lines + "NaN NaN\nEOD\n" + dots + "NaN NaN\nEOD\n";
}

struct Layer {
  std::string name, title, colour;
  double width;
};

std::string panel(const std::string& title, const std::vector<Layer>& layers) {
  std::string s =
      fmt::format("set title \"{}\" font 'sans,13' textcolor rgb '#333a45' offset 0,-0.3\nplot ", title);
  for (const Layer& layer : layers)
    s += fmt::format(
        "${0} using 1:2 with lines lw {1} lc rgb '{2}' title '{3}', \\\n"
        "  ${0}_dots using 1:2 with points pt 7 ps {4:.2f} lc rgb '{2}' notitle, \\\n  ",
        layer.name, layer.width, layer.colour, layer.title, 0.22 * layer.width);
  return s + "NaN notitle\n";
}

// A square around all ink, with a margin: the same for all panels.
std::string ranges(const RunTables& run) {
  Box box;
  for (const auto* ink : {&run.input, &run.taught, &run.ink[0], &run.ink[1]})
    if (*ink) box.extend(bounds(strokes_of(**ink)));
  if (box.isEmpty()) box.extend(Point(0, 0));
  const double half = std::max(10.0, 0.56 * box.sizes().maxCoeff() + 2);
  const Point c = box.center();
  return fmt::format("set xrange [{:.3f}:{:.3f}]\nset yrange [{:.3f}:{:.3f}]\n", c.x() - half, c.x() + half,
                     c.y() - half, c.y() + half);
}

}  // namespace

std::string drawing_script(const RunTables& run) {
  const Layer input{"input", "input drawing", "#c3cad4", 6};
  const Layer taught_on_top{"taught", "taught ink", "#1b2a41", 1.6};
  const Layer taught_below{"taught", "taught ink", "#c3cad4", 6};
  std::vector<std::string> panels;
  if (run.input && run.taught)
    panels.push_back(panel("taught to arm 1", {input, taught_on_top}));
  else if (run.taught)
    panels.push_back(panel("taught before", {taught_on_top}));
  else if (run.input)
    panels.push_back(panel("input", {input}));
  if (run.ink[0])
    panels.push_back(
        panel("copy by arm 1 (postument)", {taught_below, {"ink1", "ink of arm 1", "#1f5fa8", 1.6}}));
  if (run.ink[1])
    panels.push_back(
        panel("copy by arm 2 (track)", {taught_below, {"ink2", "ink of arm 2", "#e07b1f", 1.6}}));

  if (panels.empty()) return "";
  std::string s = fmt::format(R"(# Draws plots/drawing.png; run it in the run folder: gnuplot plots/drawing.gp
set terminal pngcairo size {},680 enhanced font 'sans,12' background rgb 'white' rounded
set output 'plots/drawing.png'
)",
                              620 * panels.size());
  s += data("input", run.input) + data("taught", run.taught) + data("ink1", run.ink[0]) +
       data("ink2", run.ink[1]);
  s += fmt::format(
      R"(set multiplot layout 1,{} title "The drawing and what the arms made of it" font 'sans:Bold,16' textcolor rgb '#1b2a41'
set size ratio -1
set border 15 lw 1 lc rgb '#98a2b0'
set tics nomirror out scale 0.5 textcolor rgb '#333a45'
set grid lw 1 lc rgb '#eef1f5'
set xlabel 'x [mm]' offset 0,0.4
set ylabel 'y [mm]' offset 1,0
set bmargin 6
set key at graph 0.5, graph -0.14 center top horizontal reverse Left samplen 2 textcolor rgb '#333a45'
)",
      panels.size());
  s += ranges(run);
  for (const std::string& p : panels) s += p;
  return s + "unset multiplot\n";
}

}  // namespace mrroc::drawing
