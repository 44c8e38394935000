// Values of SVG attributes: numbers, lengths, transforms. Internal to the SVG reader.
#pragma once
#include <Eigen/Geometry>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace mrroc::drawing::svg {

using Affine = Eigen::Affine2d;  ///< of the plane: transforms of elements

/// An attribute that cannot be read; what() says where in it and why. The reader adds element and line.
class BadValue : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads the tokens of an attribute from left to right. Independent of the locale.
class Scanner {
 public:
  /// @param text  must outlive the scanner
  explicit Scanner(std::string_view text) : text_(text) {}

  /// Passes white space. @return whether the end is reached
  bool done();
  /// Passes white space and one comma. @return whether there was a comma
  bool pass_separator();
  /// Passes this character if it is the next one. @return whether it was
  bool pass(char c);
  /// @return the next character, which is passed; done() must be false
  char take() { return text_[at_++]; }
  /// @return whether a number could begin here
  [[nodiscard]] bool at_number() const;
  /// @return the number that begins here @throws BadValue if none does or it is too large for a double
  double number();
  /// @return the arc flag that begins here, a single 0 or 1 @throws BadValue
  bool flag();
  /// @return the word of letters and % that begins here, perhaps empty
  std::string_view word();
  /// @throws BadValue with what is wrong, the place and what stands there
  [[noreturn]] void fail(std::string_view wrong) const;

 private:
  std::string_view text_;
  std::size_t at_{};
};

/// @return the numbers of a list like points or viewBox @throws BadValue
[[nodiscard]] std::vector<double> numbers(std::string_view text);

/// @param whole  what 100% is, in user units; NaN if unknown
/// @return a length in user units (px); absolute CSS units and per cent are converted
/// @throws BadValue  no number, a unit that depends on a font, or per cent of something unknown
[[nodiscard]] double length_of(std::string_view text, double whole);

/// @return the transform list of an attribute: matrix, translate, scale, rotate, skewX, skewY @throws
/// BadValue
[[nodiscard]] Affine transform(std::string_view text);

/// Maps a viewBox into a viewport (SVG 2, 8.2).
/// @param box  x, y, width, height; width and height above 0
/// @param preserve  the attribute preserveAspectRatio; empty is "xMidYMid meet"
/// @param width,height  the viewport's [user units]
[[nodiscard]] Affine view_box(const std::vector<double>& box, std::string_view preserve, double width,
                              double height);

/// @return the value of a property in a style attribute, without white space; empty if it is not there
[[nodiscard]] std::string_view style_property(std::string_view style, std::string_view name);

}  // namespace mrroc::drawing::svg
