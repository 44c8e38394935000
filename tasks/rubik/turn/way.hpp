// A way of an arm from one grip to the next: postures that it passes, and the last one where it stops.
#pragma once
#include <array>

#include "base/representation.hpp"

namespace mrroc::rubik {

/// Points of the longest way.
inline constexpr int kMostPoints = 16;

/// Which of a point's numbers is the speed of the line that leads there, as a share of the arm's limits: above 0 up to 1.
/// Those before are the motors [rad], as many as the arm has.
inline constexpr std::size_t kSpeedOfLine = kMaxAxes;

/// Points in their order, and the jaws.
struct Way {
  int count{};  ///< points that are there, 0..kMostPoints
  /// The first `count` of them count: motors [rad], and the speed at kSpeedOfLine.
  std::array<PoseNumbers, kMostPoints> points{};
  double jaws{};  ///< distance of the jaws on the way [m], 0: they stay

  /// @return nothing moves
  [[nodiscard]] bool empty() const { return count == 0 && jaws <= 0; }
  /// Adds a point behind the others; one more than kMostPoints is left out.
  void add(const PoseNumbers& point) {
    if (count < kMostPoints) points[static_cast<std::size_t>(count++)] = point;
  }
  /// @param motors [rad]  @param speed  as kSpeedOfLine
  void add(const AxisVector& motors, double speed) {
    PoseNumbers point = numbers_from_axes(motors);
    point[kSpeedOfLine] = speed;
    add(point);
  }
};

}  // namespace mrroc::rubik
