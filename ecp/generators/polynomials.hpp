// Curves made of polynomials: constant pose, constant velocity, linear, cubic and quintic splines.
#pragma once
#include <memory>
#include <vector>

#include "ecp/generators/space.hpp"

namespace mrroc::ecp {

/// A pose and the time at which it is to be reached.
struct Knot {
  double t{};        ///< [s] since the beginning of the motion
  Coordinates pose;  ///< in the space of the motion
};

/// Polynomials of at most fifth degree, one per coordinate and piece.
class Polynomials final : public Curve {
 public:
  /// Coefficients of one piece: row per coordinate, column k for the power k of the time since its beginning.
  using Coefficients = Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMaxAxes, 6>;

  /// @param times         of all knots, rising; one more than there are pieces
  /// @param coefficients  at least one piece
  /// @param end           the last point
  Polynomials(std::vector<double> times, std::vector<Coefficients> coefficients, const Coordinates& end);

  [[nodiscard]] double duration() const override { return times_.back() - times_.front(); }
  [[nodiscard]] Coordinates at(double t) const override { return t >= duration() ? end_ : derivative(t, 0); }
  /// @param order  0 to 5  @return derivative with respect to time, at a knot that of the piece behind it
  [[nodiscard]] Coordinates derivative(double t, int order) const;
  /// @return factor by which all times have to grow so that no speed and no acceleration is beyond its limit;
  ///         1 when none is
  [[nodiscard]] double slowing(const MotionLimits& limits) const;

 private:
  std::vector<double> times_;
  std::vector<Coefficients> pieces_;
  Coordinates end_;
};

using CurvePtr = std::shared_ptr<const Polynomials>;  ///< never null; shared by all copies of a trajectory

// All of these throw FaultError bad_trajectory when there are too few knots, their sizes differ, a number is
// not finite, or times do not rise.

/// Stays. @param time  [s], > 0
[[nodiscard]] CurvePtr hold(const Coordinates& pose, double time);

/// Along the straight line of the space at constant speed, from its beginning to its end without a ramp: for
/// slow motions. @param fraction  of the largest speed, above 0 up to 1; the slowest axis decides
[[nodiscard]] CurvePtr constant_velocity(const Coordinates& from, const Coordinates& to,
                                         const MotionLimits& limits, double fraction);

/// Through all knots by straight lines; continuous. At least two knots.
[[nodiscard]] CurvePtr linear_spline(const std::vector<Knot>& knots);
/// Through all knots with continuous acceleration (C2); at rest at both ends.
[[nodiscard]] CurvePtr cubic_spline(const std::vector<Knot>& knots);
/// Through all knots with four continuous derivatives (C4); speed and acceleration are zero at both ends.
[[nodiscard]] CurvePtr quintic_spline(const std::vector<Knot>& knots);

/// @return the knots with all times, counted from the first, multiplied
[[nodiscard]] std::vector<Knot> stretched(std::vector<Knot> knots, double factor);

}  // namespace mrroc::ecp
