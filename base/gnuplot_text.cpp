#include "base/gnuplot_text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace mrroc {

std::string gnuplot_quoted(std::string_view text) {
  std::string all = "'";
  for (const char c : text)
    all += c == '\'' ? std::string("''") : std::string(1, c == '\n' || c == '\r' ? '?' : c);
  return all + "'";
}

std::string gnuplot_literal(std::string_view text) {
  std::string all;
  for (const char c : text) {
    if (std::string_view("_^@&~{}\\").find(c) != std::string_view::npos) all += '\\';
    all += c;
  }
  return all;
}

std::string gnuplot_head(std::string_view output, int width, int height) {
  return fmt::format(
      "set terminal pngcairo size {},{} enhanced font 'sans,12' background rgb 'white' rounded\n"
      "set output {}\nset datafile separator ','\nset border 3 lw 1 lc rgb '#667080'\n"
      "set tics nomirror out scale 0.6 textcolor rgb '#333a45'\nset grid lt 1 lw 1 lc rgb '#e4e8ee'\n",
      width, height, gnuplot_quoted(output));
}

void AxisRange::add(double value) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

AxisRange AxisRange::with_room(double below, double above) const {
  if (empty()) return {-1, 1};
  const double span = high - low;
  const double least = 1e-9 * std::max({1.0, std::abs(low), std::abs(high)});
  if (span > least) return {low - below * span, high + above * span};
  const double around = std::max(1e-3, 0.1 * std::abs(low));
  return {low - around, high + around};
}

std::string AxisRange::text() const { return fmt::format("[{:.8g}:{:.8g}]", low, high); }

}  // namespace mrroc
