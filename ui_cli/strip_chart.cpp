#include "ui_cli/strip_chart.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace mrroc::ui {
namespace {

// From just above the lower edge of a character to its upper edge.
constexpr std::u32string_view kBlocks = U"▁▂▃▄▅▆▇█";
constexpr std::u32string_view kMarks = U"_.-=+*%#";

/// @return the smallest of 1, 2, 5 times a power of ten that is not below the value
double round_up(double value) {
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

/// Position of zero between two rows, and the value of a row.
struct Grid {
  int below{};    // rows under zero
  double unit{};  // of a row
};

/// @return the finest grid that holds the range; low < 0, at least two rows
Grid signed_grid(double low, double high, int height) {
  Grid best;
  for (int below = 1; below < height; ++below) {
    const double unit = round_up(std::max(high / (height - below), -low / below));
    if (best.below == 0 || unit < best.unit) best = {below, unit};
  }
  return best;
}

/// @param level  eighths of a character that are filled from below, > 0
char32_t from_below(double level) {
  return kBlocks[static_cast<std::size_t>(std::clamp(std::lround(level), 1L, 8L) - 1)];
}

/// @param level  eighths of a character that are filled from above, > 0: there are three such characters
char32_t from_above(double level) { return level < 2.5 ? U'▔' : level < 6.5 ? U'▀' : U'█'; }

/// Bars of a chart with negative samples.
void draw_signed(StripChart& chart, std::span<const double> shown, std::size_t first, int height) {
  constexpr double kEighths = 8;
  const Grid grid =
      height > 1 ? signed_grid(chart.low, chart.high, height) : Grid{0, std::max(chart.high, -chart.low)};
  if (height > 1) {
    chart.low = -grid.unit * grid.below;
    chart.high = grid.unit * (height - grid.below);
  }
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (!std::isfinite(shown[k])) continue;
    const bool up = shown[k] >= 0;
    double level = std::max(1.0, std::abs(shown[k]) / grid.unit * kEighths);  // zero has a mark as well
    // The row above or below the line of zero, and then away from it.
    const int zero = height > 1 ? height - grid.below - (up ? 1 : 0) : 0;
    for (int row = zero; row >= 0 && row < height && level > 0; row += up ? -1 : 1, level -= kEighths)
      chart.rows[static_cast<std::size_t>(row)][first + k] = up ? from_below(level) : from_above(level);
  }
}

}  // namespace

StripChart strip_chart(std::span<const double> samples, int width, int height, Glyphs glyphs,
                       double least_span) {
  const std::u32string_view levels = glyphs == Glyphs::unicode ? kBlocks : kMarks;
  const auto columns = static_cast<std::size_t>(std::max(width, 0));
  const auto shown = samples.last(std::min(samples.size(), columns));
  StripChart chart;
  chart.rows.assign(static_cast<std::size_t>(std::max(height, 0)), std::u32string(columns, U' '));
  chart.high = least_span;
  for (const double s : shown) {
    if (!std::isfinite(s)) continue;
    if (s > chart.high) chart.high = round_up(s);
    if (s < std::min(chart.low, -least_span / 10)) chart.low = -round_up(-s);
  }
  if (glyphs == Glyphs::unicode && chart.low < 0 && height > 0) {
    draw_signed(chart, shown, columns - shown.size(), height);
    return chart;
  }
  const auto per_row = static_cast<int>(levels.size());
  const int top = height * per_row;  // levels are counted 1..top from the lower edge
  for (std::size_t k = 0; k < shown.size(); ++k) {
    if (!std::isfinite(shown[k])) continue;
    const double share = (shown[k] - chart.low) / (chart.high - chart.low);
    const int level = std::clamp(static_cast<int>(std::lround(share * (top - 1))) + 1, 1, top);
    const std::size_t column = columns - shown.size() + k;
    for (int row = 0; row < height; ++row) {
      const int above = level - per_row * (height - 1 - row);  // in this character
      if (above <= 0) continue;
      // Blocks fill what is under the curve, marks draw the curve.
      if (glyphs == Glyphs::ascii && above > per_row) continue;
      chart.rows[static_cast<std::size_t>(row)][column] =
          levels[static_cast<std::size_t>(std::min(above, per_row) - 1)];
    }
  }
  return chart;
}

}  // namespace mrroc::ui
