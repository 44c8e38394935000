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
