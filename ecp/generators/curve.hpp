// A motion as a function of time, the result of every trajectory generator.
#pragma once
#include "base/axes.hpp"

namespace mrroc::ecp {

/// Coordinates of a pose in one space: motors [rad], joints [rad, track m], or x, y, z [m] and three angles
/// [rad] (Euler ZYZ or angle-axis). One number per axis, or six.
using Coordinates = AxisVector;

/// A curve in such a space. Immutable once made, so that a memory c_c may share it. Not real-time safe.
class Curve {
 public:
  Curve() = default;
  virtual ~Curve() = default;
  Curve(const Curve&) = delete;
  Curve& operator=(const Curve&) = delete;

  /// @return time from the first to the last point [s], >= 0
  [[nodiscard]] virtual double duration() const = 0;
  /// @param t  [s]; before 0 the first point is meant, after duration() exactly the last one
  /// @return the coordinates then
  [[nodiscard]] virtual Coordinates at(double t) const = 0;
};

}  // namespace mrroc::ecp
