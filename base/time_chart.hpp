// Charts over time, one below the other, as a gnuplot script.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/gnuplot_text.hpp"

namespace mrroc {

/// A stretch of time in which an arm executed one behaviour.
struct TimeBand {
  double from{}, to{};  ///< [s], from < to
  int m{};              ///< the behaviour's number; 0: the stretch has none
  std::string name{};   ///< the behaviour's name
};

/// Makes bands of rows that tell which behaviour there is.
/// @param rows  in the order of time
/// @param time  double(row): when the row is of [s]
/// @param m     int(row): the behaviour's number
/// @param name  std::string(int m)
/// @param none  of rows without a behaviour: there is no band then
/// @return stretches of rows with the same m, each until the row that ends it
template <class Rows, class Time, class Number, class Name>
[[nodiscard]] std::vector<TimeBand> time_bands(const Rows& rows, Time time, Number m, Name name,
                                               int none = 0) {
  std::vector<TimeBand> bands;
  int before = none;
  for (const auto& row : rows) {
    const double t = time(row);
    const int now = m(row);
    if (before != none) bands.back().to = t;
    if (now != before && now != none) bands.push_back({t, t, now, name(now)});
    before = now;
  }
  return bands;
}

/// Style of a curve.
enum class CurveStyle { lines, dashes, points, steps };

/// One curve of a panel.
struct ChartCurve {
  std::string source{};  ///< as behind `plot`: "$table1 using 1:2", "'arm1.csv' skip 1 using 2:12"
  std::string title{};   ///< in the legend, in gnuplot's enhanced mode; empty: not there
  std::string colour{};  ///< "#rrggbb"
  CurveStyle style{CurveStyle::lines};  ///< how it is drawn
  double width{1.6};                    ///< of the line; of points: their size
};

/// A point that is marked by a letter.
struct ChartMark {
  std::string letter{};  ///< beside the point
  double t{}, y{};       ///< where it is [s], [unit of the panel]
  std::string words{};   ///< what it means, told below the picture
};

/// One chart.
struct ChartPanel {
  std::string title{};               ///< at the left above it, in enhanced mode
  std::string y_label{};             ///< with the unit, in enhanced mode
  AxisRange y{};                     ///< as drawn; empty: gnuplot chooses
  std::vector<TimeBand> bands{};     ///< shown in a lane above it, in the order of time
  std::vector<ChartCurve> curves{};  ///< those later are drawn over those before
  std::vector<ChartMark> marks{};    ///< over the curves
  std::string commands{};            ///< gnuplot's, for this panel only; each with its line feed
  int height{240};                   ///< [pixels]
};

/// A picture.
struct TimeChart {
  std::string output{};              ///< PNG file, as gnuplot is to write it
  std::string title{};               ///< in enhanced mode
  double from{}, to{};               ///< shown time [s], from < to
  std::vector<ChartPanel> panels{};  ///< from the top
  std::vector<std::string> notes{};  ///< lines below, in enhanced mode
  int left{100};                     ///< room for tics and labels at the left [pixels]
  std::string data{};                ///< data blocks that the curves name
};

/// Behaviours are named in their lane where there is room; of the others it shows the number, and the names stand
/// below the picture. Legends stand above the panels, never over the data.
/// @return the script
[[nodiscard]] std::string time_chart_script(const TimeChart& chart);

}  // namespace mrroc
