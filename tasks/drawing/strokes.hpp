// Geometry of polylines: extent, length, resampling and the nearest point.
#pragma once
#include <Eigen/Geometry>

#include "tasks/drawing/drawing.hpp"

namespace mrroc::drawing {

/// An axis-parallel box [mm]; isEmpty() when it holds no point.
using Box = Eigen::AlignedBox2d;

/// @return the bounding box of all points
[[nodiscard]] Box bounds(const Drawing& drawing);

/// @return the length of the polyline [mm]
[[nodiscard]] double length(const Stroke& stroke);

/// @param spacing_mm  wanted distance between neighbours along the polyline, above 0
/// @return points evenly spaced along the polyline, both ends included, as near to the wanted spacing as a
/// whole number of pieces allows. A dot stays a dot, an empty stroke stays empty.
[[nodiscard]] Stroke resampled(const Stroke& stroke, double spacing_mm);

/// @param count  number of points, at least 2
/// @return that many points evenly spaced along the polyline, both ends included. An empty stroke stays
/// empty.
[[nodiscard]] Stroke resampled_to(const Stroke& stroke, std::size_t count);

/// Answers which point of one polyline is nearest. Keeps a tree of boxes around its segments, so that a
/// question costs about the logarithm of their number.
class NearestPoint {
 public:
  /// @param stroke  at least one point
  explicit NearestPoint(Stroke stroke);

  /// @return the point of the polyline (not only of its corners) that is nearest to p
  [[nodiscard]] Point operator()(const Point& p) const;
  /// @return the distance of p from the polyline [mm]
  [[nodiscard]] double distance(const Point& p) const { return ((*this)(p)-p).norm(); }

 private:
  // Segments first to last - 1; segment k joins points k and k + 1.
  struct Range {
    std::size_t node, first, last;
    [[nodiscard]] bool leaf() const;
    [[nodiscard]] Range half(std::size_t which) const;
  };
  struct Best {
    Point point;
    double square;
  };
  void build(const Range& range);
  void search(const Range& range, const Point& p, Best& best) const;

  Stroke points_;
  std::vector<Box> boxes_;  // a binary tree: the halves of node k are nodes 2 k + 1 and 2 k + 2
};

}  // namespace mrroc::drawing
