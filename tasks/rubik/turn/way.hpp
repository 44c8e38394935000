// A way of an arm from one grip to the next: points in joint space that it passes, and the last one where it stops.
#pragma once
#include <array>

#include "ecp/generators/trapezoid.hpp"

namespace mrroc::rubik {

/// Points of the longest way.
inline constexpr int kMostPoints = 16;

/// The points, each of as many joints as the arm has [rad, track m].
struct Way {
  int count{};
  std::array<PoseNumbers, kMostPoints> points{};
  double jaws{};  ///< distance of the jaws on the way [m], 0: they stay

  void add(const PoseNumbers& joints) {
    if (count < kMostPoints) points[static_cast<std::size_t>(count++)] = joints;
  }
};

}  // namespace mrroc::rubik
