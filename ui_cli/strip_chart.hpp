// Draws a curve over time with characters.
#pragma once
#include <span>
#include <string>
#include <vector>

namespace mrroc::ui {

/// Which characters a terminal can show.
enum class Glyphs { ascii, unicode };

/// A chart and its scale.
struct StripChart {
  std::vector<std::u32string> rows;  ///< from the top; every one has the width asked for
  double low{};                      ///< value of the lower edge, <= 0, in the unit of the samples
  double high{};                     ///< value of the upper edge, >= least_span
};

/// Draws the newest samples, one per column, the newest at the right: in unicode bars that begin at zero, in ASCII marks on
/// the curve. The range always holds zero and widens in steps 1, 2, 5, so that the scale does not move with every sample.
/// Bars of a chart with negative samples begin at the line between two rows, which its range is chosen for; in a single
/// row those of positive samples stand on its lower edge, and those of negative ones hang from its upper edge. A sample that is not finite leaves
/// its column empty; one that is less than least_span / 10 below zero, such as noise, is drawn at the edge.
/// @param samples oldest first
/// @param width,height [characters], >= 0
/// @param least_span smallest upper edge, > 0
StripChart strip_chart(std::span<const double> samples, int width, int height, Glyphs glyphs,
                       double least_span);

}  // namespace mrroc::ui
