// A curve in a plane by its length, and the place on it that is nearest to a tool.
#pragma once
#include <Eigen/Core>
#include <cstddef>
#include <stdexcept>
#include <vector>

namespace mrroc::guide {

/// Points in the plane of a fixture [m].
using Point = Eigen::Vector2d;
using Points = std::vector<Point>;

/// A corner that cannot be a fixture: across it nearest places would not be unique.
class SharpCorner : public std::runtime_error {
 public:
  explicit SharpCorner(const Point& where);
  /// @return where it is [m]
  [[nodiscard]] const Point& where() const { return where_; }

 private:
  Point where_;
};

/// A place on a curve.
struct CurvePlace {
  double s{};                     ///< length from the beginning [m]
  Point point{Point::Zero()};     ///< [m]
  Point tangent{Point::UnitX()};  ///< of length 1, in the direction of growing s
  double beyond{};  ///< how far what was looked for is beyond an end, along its tangent [m]; before the
                    ///< beginning negative; 0: at neither end
};

/// A smooth curve, made of a polyline whose corners are rounded. Constant; every function is pure.
class Curve {
 public:
  /// Bends are at least so wide: a tool that is nearer than that has one nearest place [m].
  static constexpr double kLeastRadius = 0.5e-3;
  /// What is near a place, along the curve to either side [m].
  static constexpr double kNear = 3e-3;
  /// Shortest curve [m].
  static constexpr double kLeastLength = 5e-3;

  /// @param points    at least two; repeated ones do not matter
  /// @param closed    its end is its beginning, which is not given twice
  /// @param rounding  a place of the curve is the mean of the polyline over so much length to either side [m]; 0: the
  ///                  polyline is smooth enough as it is
  /// @throws SharpCorner  a bend is narrower than kLeastRadius also when it is rounded
  /// @throws std::invalid_argument  shorter than kLeastLength
  Curve(const Points& points, bool closed, double rounding);

  /// @return [m]
  [[nodiscard]] double length() const { return length_; }
  /// @return whether it has no ends
  [[nodiscard]] bool closed() const { return closed_; }
  /// @param s  [m]; of a closed curve any number, of an open one clipped to it
  [[nodiscard]] CurvePlace at(double s) const;
  /// @param s  of a place near by [m]: the search goes from there downhill, so that it neither leaves a branch at a crossing
  ///           nor jumps
  /// @return the nearest place to p on that branch
  [[nodiscard]] CurvePlace nearest(const Point& p, double s) const;
  /// @return the nearest place to p of all
  [[nodiscard]] CurvePlace nearest(const Point& p) const;
  /// @return radius of the narrowest bend around s [m]
  [[nodiscard]] double radius(double s) const;
  /// @return radius of the narrowest bend within kNear of s [m]
  [[nodiscard]] double narrowest(double s) const { return narrowest_[wrapped(index_near(s))]; }
  /// @return points at equal distances, for pictures; of a closed curve the first one is not repeated
  [[nodiscard]] const Points& points() const { return points_; }

 private:
  [[nodiscard]] std::size_t intervals() const { return closed_ ? points_.size() : points_.size() - 1; }
  [[nodiscard]] std::size_t wrapped(std::ptrdiff_t k) const;
  [[nodiscard]] std::ptrdiff_t index_near(double s) const;
  [[nodiscard]] CurvePlace place_around(const Point& p, std::ptrdiff_t k) const;
  void find_tangents();
  void find_bends();

  bool closed_;
  double length_{}, spacing_{};
  Points points_, tangents_;
  std::vector<double> narrowest_;  // at the points [m]
};

}  // namespace mrroc::guide
