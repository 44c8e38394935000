// A path of an arm in its joints from one grip to the next: postures on the way, and the last one where it
// stops.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "base/axes.hpp"

namespace mrroc::rubik {

/// Points of the longest path.
inline constexpr int kMostPoints = 16;

/// A posture on a path, and the line that leads there. Trivially copyable.
struct PathPoint {
  std::array<double, kMaxAxes> motors{};  ///< [rad], as many as the arm has
  double speed{};  ///< on the line, as a share of the arm's limits: above 0 up to 1; 0: this is no point

  friend bool operator==(const PathPoint&, const PathPoint&) = default;
  /// @return whether an arm can go there
  [[nodiscard]] bool sound() const {
    return std::ranges::all_of(motors, [](double q) { return std::isfinite(q); }) && speed > 0 && speed <= 1;
  }
};

/// Points in their order, and the jaws.
struct JointPath {
  int count{};                                  ///< points that are there, 0..kMostPoints
  std::array<PathPoint, kMostPoints> points{};  ///< the first `count` of them count
  double jaws{};                                ///< distance of the jaws on the path [m], 0: they stay

  /// @return nothing moves
  [[nodiscard]] bool empty() const { return count == 0 && jaws <= 0; }
  /// Adds a point behind the others; one more than kMostPoints is left out.
  void add(const PathPoint& point) {
    if (count < kMostPoints) points[static_cast<std::size_t>(count++)] = point;
  }
  /// @param motors [rad]  @param speed  as PathPoint::speed
  void add(const AxisVector& motors, double speed) {
    PathPoint point{.speed = speed};
    std::ranges::copy(motors, point.motors.begin());
    add(point);
  }
};

}  // namespace mrroc::rubik
