// Non-uniform rational B-splines.
#pragma once
#include <vector>

#include "ecp/generators/curve.hpp"

namespace mrroc::ecp {

/// Definition of a NURBS curve.
struct NurbsShape {
  int degree{3};                     ///< 1 to 5
  std::vector<Coordinates> control;  ///< control points, at least degree + 1
  std::vector<double> weights;       ///< one per control point, > 0; empty: all 1 (a B-spline)
  /// Control points + degree + 1 numbers that do not fall, the inner ones at most degree times; empty: evenly
  /// spaced and clamped, so that the curve begins and ends in its first and last control point.
  std::vector<double> knots;
};

/// The curve, its parameter running evenly with time from one end to the other. degree - 1 derivatives with
/// respect to time are continuous where knots are single. It stays within the hull of its control points.
class Nurbs final : public Curve {
 public:
  /// @param time  from the first to the last point [s], > 0
  /// @throws FaultError bad_trajectory  a shape that is none
  Nurbs(NurbsShape shape, double time);

  [[nodiscard]] double duration() const override { return time_; }
  /// By de Boor's algorithm, in homogeneous coordinates.
  [[nodiscard]] Coordinates at(double t) const override;

 private:
  [[nodiscard]] Coordinates point(double u) const;

  NurbsShape shape_;
  double time_;
};

}  // namespace mrroc::ecp
