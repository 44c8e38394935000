#include "base/time_chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace mrroc {
namespace {

// Sizes in pixels.
constexpr int kWidth = 1200, kRight = 28;
constexpr int kTitle = 46, kHeader = 26, kLane = 21, kTics = 40, kTimeLabel = 26, kNote = 19, kBottom = 8;
constexpr double kSmall = 6.8, kNormal = 8.0;  // mean width of a character at 10 and at 11 points
constexpr int kLegendLine = 26, kLegendApart = 22;

constexpr const char* kText = "#333a45";
constexpr std::string_view kLanes[]{"#d3dfee", "#eaeff6"};

/// Rows of a legend: indices of curves.
using Legend = std::vector<std::vector<std::size_t>>;

/// The picture's size, as far as it is known while it is written.
class Layout {
 public:
  Layout(int height, int left) : height_(height), left_(left) {}
  /// @return a height below the upper edge in gnuplot's screen coordinates
  [[nodiscard]] double y(double below_top) const { return 1 - below_top / height_; }
  /// @return where charts begin [pixels from the left edge], and how wide they are [pixels]
  [[nodiscard]] int left() const { return left_; }
  [[nodiscard]] int inner() const { return kWidth - kRight - left_; }
  /// @return a distance from the left edge in screen coordinates
  [[nodiscard]] static double x(double from_left) { return from_left / kWidth; }

 private:
  double height_;
  int left_;
};

/// @return how many characters a text in enhanced mode shows
std::size_t shown_size(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return c != '\\' && c != '{' && c != '}'; }));
}

int legend_width(const ChartCurve& curve) {
  return kLegendLine + 6 + static_cast<int>(kNormal * static_cast<double>(shown_size(curve.title))) +
         kLegendApart;
}

Legend legend_of(const ChartPanel& panel, int inner) {
  const int title = static_cast<int>(kNormal * static_cast<double>(shown_size(panel.title))) + kLegendApart;
  Legend legend(1);
  int room = inner - title;
  for (std::size_t k = 0; k < panel.curves.size(); ++k) {
    if (panel.curves[k].title.empty()) continue;
    const int width = legend_width(panel.curves[k]);
    if (width > room && !(legend.back().empty() && legend.size() > 1)) {
      legend.emplace_back();
      room = inner;
    }
    room -= width;
    legend.back().push_back(k);
  }
  return legend;
}

std::string label(const std::string& text, double x, double y, const char* place, const char* font) {
  return fmt::format("set label {} at screen {:.5f}, screen {:.5f} {} font '{}' textcolor rgb '{}' front\n",
                     gnuplot_quoted(text), x, y, place, font, kText);
}

const char* dash_of(const ChartCurve& curve) { return curve.style == CurveStyle::dashes ? " dt 2" : ""; }

/// A piece of a legend's line.
/// @param from,to  [pixels from the left edge]
std::string stroke(const ChartCurve& curve, double from, double to, double y) {
  return fmt::format(
      "set arrow from screen {0:.5f}, screen {2:.5f} to screen {1:.5f}, screen {2:.5f} nohead lw {3:.3g} lc "
      "rgb '{4}' "
      "front\n",
      Layout::x(from), Layout::x(to), y, std::max(2.0, curve.width), curve.colour);
}

/// @param top  of the header [pixels below the upper edge]
std::string header(const Layout& at, const ChartPanel& panel, const Legend& legend, int top) {
  std::string text;
  for (std::size_t row = 0; row < legend.size(); ++row) {
    const double y = at.y(top + kHeader * (static_cast<double>(row) + 0.5));
    if (row == 0) text += label(panel.title, Layout::x(at.left()), y, "left", "sans:Bold,11");
    int left = kWidth - kRight + kLegendApart;
    for (const std::size_t k : legend[row]) left -= legend_width(panel.curves[k]);
    for (const std::size_t k : legend[row]) {
      const ChartCurve& curve = panel.curves[k];
      if (curve.style == CurveStyle::points)
        text += fmt::format(
            "set label '' at screen {:.5f}, screen {:.5f} point pt 7 ps {:.3g} lc rgb '{}' front\n",
            Layout::x(left + kLegendLine / 2.0), y, std::max(0.8, curve.width), curve.colour);
      else if (curve.style == CurveStyle::dashes)
        text += stroke(curve, left, left + 0.4 * kLegendLine, y) +
                stroke(curve, left + 0.6 * kLegendLine, left + kLegendLine, y);
      else
        text += stroke(curve, left, left + kLegendLine, y);
      text += label(curve.title, Layout::x(left + kLegendLine + 6), y, "left", "sans,11");
      left += legend_width(curve);
    }
  }
  return text;
}

std::string words_of(const TimeBand& band) {
  return band.m > 0 ? fmt::format("{} {}", band.m, band.name) : band.name;
}

/// Numbers and names of behaviours.
using Behaviours = std::set<std::pair<int, std::string>>;

/// Which behaviours a lane has named, and for which there was no room.
struct Named {
  Behaviours whole, by_number;
};

/// The lane of behaviours, and lines where one ends and the next begins.
/// @param top  of the lane [pixels]
std::string lane(const Layout& at, const TimeChart& chart, const ChartPanel& panel, int top, Named& named) {
  const double scale = at.inner() / (chart.to - chart.from);
  std::string text;
  double last_line = -1e9;
  std::size_t k = 0;
  for (const TimeBand& band : panel.bands) {
    const double from = std::max(band.from, chart.from), to = std::min(band.to, chart.to);
    if (!(to > from)) continue;
    text += fmt::format(
        "set object rectangle from first {:.6g}, screen {:.5f} to first {:.6g}, screen {:.5f} fillcolor rgb "
        "'{}' "
        "fillstyle solid 1 noborder behind noclip\n",
        from, at.y(top + kLane - 3), to, at.y(top), kLanes[k++ % std::size(kLanes)]);
    const double begins = (from - chart.from) * scale, width = (to - from) * scale;
    const std::string words = words_of(band), number = band.m > 0 ? std::to_string(band.m) : "";
    const auto fits = [width](const std::string& t) {
      return kSmall * static_cast<double>(t.size()) + 6 <= width;
    };
    const std::string& shown = fits(words) ? words : number;
    if (!shown.empty() && fits(shown))
      text += fmt::format(
          "set label {} at first {:.6g}, screen {:.5f} center font 'sans,10' textcolor rgb '{}' front\n",
          gnuplot_quoted(gnuplot_literal(shown)), (from + to) / 2, at.y(top + (kLane - 3) / 2.0), kText);
    if (!band.name.empty()) (fits(words) ? named.whole : named.by_number).emplace(band.m, band.name);
    constexpr double kLinesApart = 8;
    if (begins - last_line < kLinesApart || begins <= 0) continue;
    last_line = begins;
    text += fmt::format(
        "set arrow from first {0:.6g}, graph 0 to first {0:.6g}, graph 1 nohead lw 1 lc rgb '#b9c3d0' "
        "dt 3 back\n",
        from);
  }
  return text;
}

std::string marks_text(const ChartPanel& panel) {
  std::string text;
  for (const ChartMark& mark : panel.marks)
    text += fmt::format(
        "set label {} at first {:.6g}, first {:.6g} point pt 7 ps 0.9 lc rgb '#1b2a41' offset character "
        "0.6,0.6 font "
        "'sans:Bold,12' textcolor rgb '#1b2a41' front\n",
        gnuplot_quoted(gnuplot_literal(mark.letter)), mark.t, mark.y);
  return text;
}

std::string curve_text(const ChartCurve& curve) {
  const std::string ink = fmt::format("lc rgb '{}'", curve.colour);
  switch (curve.style) {
    case CurveStyle::lines:
    case CurveStyle::dashes:
      return fmt::format("{} with lines lw {:.3g} {}{} notitle", curve.source, curve.width, ink,
                         dash_of(curve));
    case CurveStyle::points:
      return fmt::format("{} with points pt 7 ps {:.3g} {} notitle", curve.source, curve.width, ink);
    case CurveStyle::steps:
      return fmt::format("{} with steps lw {:.3g} {} notitle", curve.source, curve.width, ink);
  }
  return {};
}

std::string plot_text(const ChartPanel& panel) {
  std::string text = "plot ";
  for (const ChartCurve& curve : panel.curves) text += curve_text(curve) + ", \\\n  ";
  return text + "NaN notitle\n";  // a panel without a curve has its axes all the same
}

/// Explanations, one behind the other in lines that fit; none is broken.
/// @param inner  width of the charts [pixels]
void add_notes(std::vector<std::string>& notes, int inner, const std::string& first,
               const std::vector<std::string>& parts) {
  const auto room = static_cast<std::size_t>(inner / kSmall);
  std::string line = first;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const std::string part = parts[k] + (k + 1 < parts.size() ? ",  " : "");
    if (line.size() + part.size() > room && line.size() > first.size()) {
      notes.push_back(std::move(line));
      line.clear();
    }
    line += part;
  }
  if (!parts.empty()) notes.push_back(std::move(line));
}

std::vector<std::string> notes_of(const TimeChart& chart, const Named& named) {
  const int inner = Layout(1, chart.left).inner();
  std::vector<std::string> notes = chart.notes, marks, behaviours, others;
  for (const ChartPanel& panel : chart.panels)
    for (const ChartMark& mark : panel.marks)
      if (!mark.words.empty()) marks.push_back(gnuplot_literal(mark.letter + " " + mark.words));
  add_notes(notes, inner, "", marks);
  for (const auto& [m, name] : named.by_number)
    if (!named.whole.contains({m, name}))
      (m > 0 ? behaviours : others).push_back(gnuplot_literal(words_of({.m = m, .name = name})));
  add_notes(notes, inner, "behaviours:  ", behaviours);
  add_notes(notes, inner, "without a number:  ", others);
  return notes;
}

/// @param notes  lines below the panels  @return height of the whole picture [pixels]
int height_of(const TimeChart& chart, std::size_t notes) {
  int height = kTitle + kTimeLabel + kBottom + kNote * static_cast<int>(notes);
  for (const ChartPanel& panel : chart.panels)
    height += kHeader * static_cast<int>(legend_of(panel, Layout(1, chart.left).inner()).size()) +
              (panel.bands.empty() ? 0 : kLane) + panel.height + kTics;
  return height;
}

std::string panel_text(const Layout& at, const TimeChart& chart, const ChartPanel& panel, int& top, bool last,
                       Named& named) {
  const Legend legend = legend_of(panel, at.inner());
  std::string text = header(at, panel, legend, top);
  top += kHeader * static_cast<int>(legend.size());
  if (!panel.bands.empty()) {
    text += lane(at, chart, panel, top, named);
    top += kLane;
  }
  text += fmt::format("set tmargin at screen {:.5f}\n", at.y(top));
  constexpr double kLabel = 16;  // its middle [pixels from the left edge]; the same for all panels
  text += fmt::format(
      "set label {} at screen {:.5f}, screen {:.5f} center rotate by 90 font 'sans,12' textcolor rgb '{}' "
      "front\n",
      gnuplot_quoted(panel.y_label), Layout::x(kLabel), at.y(top + panel.height / 2.0), kText);
  top += panel.height;
  text += fmt::format("set bmargin at screen {:.5f}\n", at.y(top));
  top += kTics;
  text += panel.y.empty() ? "set yrange [*:*]\n" : fmt::format("set yrange {}\n", panel.y.text());
  if (last) text += "set xlabel 'simulated time t [s]' offset 0,0.3\n";
  return text + marks_text(panel) + panel.commands + plot_text(panel) +
         "unset label\nunset arrow\nunset object\nset ytics autofreq\nunset logscale y\n";
}

}  // namespace

std::string time_chart_script(const TimeChart& chart) {
  Named named;
  const auto panels = [&](int height) {
    const Layout at(height, chart.left);
    std::string text;
    int top = kTitle;
    for (const ChartPanel& panel : chart.panels)
      text += panel_text(at, chart, panel, top, &panel == &chart.panels.back(), named);
    return text;
  };
  panels(1);  // tells which behaviours find no room
  const std::vector<std::string> notes = notes_of(chart, named);
  const int height = height_of(chart, notes.size());
  const Layout at(height, chart.left);
  std::string text = gnuplot_head(chart.output, kWidth, height) + chart.data;
  text += "set multiplot\nunset key\n";
  text +=
      fmt::format("set lmargin at screen {:.5f}\nset rmargin at screen {:.5f}\nset xrange [{:.8g}:{:.8g}]\n",
                  Layout::x(chart.left), Layout::x(kWidth - kRight), chart.from, chart.to);
  text += fmt::format(
      "set label {} at screen 0.5, screen {:.5f} center font 'sans:Bold,15' textcolor rgb '#1b2a41'\n",
      gnuplot_quoted(chart.title), at.y(kTitle / 2.0));
  for (std::size_t k = 0; k < notes.size(); ++k)
    text += label(notes[k], Layout::x(chart.left),
                  at.y(height - kBottom - kNote * (static_cast<double>(notes.size() - k) - 0.5)), "left",
                  "sans,10");
  return text + panels(height) + "unset multiplot\n";
}

}  // namespace mrroc
