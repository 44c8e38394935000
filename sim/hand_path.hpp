// The line that the hand follows, and a person's speed along it.
#pragma once
#include <Eigen/Core>
#include <vector>

namespace mrroc::sim {

/// Cuts a polyline at its corners.
/// @param points  at least one [any unit]
/// @param corner  turn that makes a corner [rad]
/// @return pieces in order; each begins with the point at which the one before ends
std::vector<std::vector<Eigen::Vector2d>> cut_at_corners(const std::vector<Eigen::Vector2d>& points,
                                                         double corner);

/// A smooth line with a speed for each place: at rest at both ends, slower in bends.
class HandPath {
 public:
  /// Bounds of the speed along the line.
  struct Limits {
    double speed{};         ///< [m/s], positive
    double acceleration{};  ///< along the line and, in bends, across it [m/s^2], positive
  };

  /// An empty path: no length, at the origin.
  HandPath() = default;

  /// @param points  at least one [m]; a path of one point has no length
  HandPath(const std::vector<Eigen::Vector2d>& points, const Limits& limits);

  /// @return [m]
  [[nodiscard]] double length() const { return length_; }
  /// @param s  from the beginning [m], clipped to the path @return place [m]
  [[nodiscard]] Eigen::Vector2d at(double s) const;
  /// @param s  from the beginning [m] @return planned speed [m/s], positive so that the end is reached
  [[nodiscard]] double speed_at(double s) const;

 private:
  // Index of the sample before s and how far s is beyond it, in samples.
  [[nodiscard]] std::pair<std::size_t, double> locate(double s) const;

  std::vector<Eigen::Vector2d> points_{Eigen::Vector2d::Zero()};  // at equal distances along the line
  std::vector<double> speed_{0};
  double spacing_{};
  double length_{};
};

}  // namespace mrroc::sim
