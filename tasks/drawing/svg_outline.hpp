// Outlines of SVG shapes: sub-paths of curves that can be moved and flattened. Internal to the SVG reader.
#pragma once
#include <array>
#include <variant>
#include <vector>

#include "tasks/drawing/drawing.hpp"
#include "tasks/drawing/svg_values.hpp"

namespace mrroc::drawing::svg {

/// Curves of a drawing, at most: ten per point that it may have.
inline constexpr std::size_t kMaxCurves = 10 * kMaxPoints;

/// A cubic Bezier curve; straight lines and quadratic curves are written as one.
struct Cubic {
  std::array<Point, 4> p;  ///< begin, two control points, end [user units]
};

/// Part of an ellipse: centre + a cos(angle) + b sin(angle), where angle runs from `from` by `sweep` [rad].
/// With conjugate half axes a and b it stays one under every affine transform.
struct Arc {
  Point centre, a, b;      ///< [user units]
  double from{}, sweep{};  ///< [rad]; sweep of either sign
};

using Segment = std::variant<Cubic, Arc>;  ///< any curve of an outline

/// One stroke before it is flattened: at least one segment, each beginning where the one before ended.
struct SubPath {
  Point start;                    ///< [user units]
  std::vector<Segment> segments;  ///< in drawing order
};

/// Collects sub-paths from pen movements, with SVG's rules for closing and for sub-paths without extent.
class Outline {
 public:
  // All movements that draw throw BadValue when there are more than kMaxCurves of them.

  /// Pen movements, from the current point to p: without drawing, straight, by one control point, by two.
  void move_to(const Point& p);
  void line_to(const Point& p);
  void quadratic_to(const Point& c, const Point& p);
  void cubic_to(const Point& c1, const Point& c2, const Point& p);
  /// An arc of an ellipse with half axes rx, ry [user units] turned by `degrees`; the flags choose one of the
  /// four arcs that end in p. Radii that are too small grow; a radius 0 gives a line (SVG 2, 9.5.1).
  void arc_to(double rx, double ry, double degrees, bool large, bool sweep, const Point& p);
  /// A quarter or more of an axis-parallel ellipse around `centre`, beginning at the current point.
  void ellipse(const Point& centre, double rx, double ry, double from, double sweep);
  /// A straight line to where the sub-path began. What follows begins there anew.
  void close();

  /// @return where the pen is
  [[nodiscard]] const Point& current() const { return current_; }
  /// @return all sub-paths that draw something, transformed
  [[nodiscard]] std::vector<SubPath> sub_paths(const Affine& T) const;

 private:
  void add(const Segment& segment, const Point& end);

  std::vector<SubPath> paths_;
  Point current_{0, 0};
  bool open_{false};
  std::size_t curves_{};
};

/// @return whether every number of it is finite
[[nodiscard]] bool finite(const SubPath& path);

/// @return into how many equal steps of its parameter the segment has to be cut so that no chord is farther
/// than `tolerance` from it: h^2 max|f''| / 8 bounds that distance. At least 1; huge or NaN for absurd input.
[[nodiscard]] double pieces(const Segment& segment, double tolerance);

/// Appends the ends of `count` equal steps of the segment's parameter.
void append(Stroke& stroke, const Segment& segment, int count);

}  // namespace mrroc::drawing::svg
