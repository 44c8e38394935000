// Parts that all gnuplot scripts share: the style of the pictures, and the quoting of texts.
#pragma once
#include <array>
#include <string>
#include <string_view>

namespace mrroc {

/// Colours of curves that colour-blind people can tell apart (Okabe and Ito, and a dark red of Tol's in the place of their
/// yellow, which is too pale for a line), one for each axis of an arm; take the first ones first.
inline constexpr std::array<std::string_view, 8> kCurveColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                                               "#e69f00", "#56b4e9", "#000000", "#882255"};
/// @return colour of the k-th curve; those after the last begin again
[[nodiscard]] constexpr std::string_view curve_colour(std::size_t k) {
  return kCurveColours[k % kCurveColours.size()];
}

/// Style of reference lines, such as a desired force.
inline constexpr std::string_view kReferenceColour = "#4b5563";

/// @return the text in single quotes, as gnuplot reads it; a line feed becomes a question mark
[[nodiscard]] std::string gnuplot_quoted(std::string_view text);

/// @return the text so that gnuplot's enhanced mode shows its characters as they are: "a_b" has no subscript
[[nodiscard]] std::string gnuplot_literal(std::string_view text);

/// @param output  PNG file, as gnuplot is to write it  @param width,height [pixels]
/// @return the head of a script: PNG, separator of CSV files, axes, tics and grid
[[nodiscard]] std::string gnuplot_head(std::string_view output, int width, int height);

/// Values of an axis.
struct AxisRange {
  double low{1e300}, high{-1e300};  ///< low > high: none yet

  /// Extends it; a value that is not finite is left out.
  void add(double value);
  /// @return whether no value was added
  [[nodiscard]] bool empty() const { return low > high; }
  /// @param below,above  shares of the range to add at its ends  @return it with room; [-1, 1] without a value, and
  ///                     one around a single value
  [[nodiscard]] AxisRange with_room(double below = 0.06, double above = 0.06) const;
  /// @return "[low:high]"
  [[nodiscard]] std::string text() const;
};

}  // namespace mrroc
