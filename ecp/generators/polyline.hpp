// Straight lines from pose to pose, all axes in step; corners as fast as the axes' accelerations permit.
#pragma once
#include <vector>

#include "ecp/generators/trapezoid.hpp"

namespace mrroc::ecp {

/// Never leaves the lines, unlike Trapezoid, where each axis has a profile of its own: what has been checked along the
/// lines holds for the motion. On a line every axis has its share of one speed, which rises and falls evenly; it is
/// looked ahead over all lines, so that short ones are no hindrance. At a pose that is passed all axes change their
/// speed at once, each by no more than its acceleration changes it in one macrostep anyway.
class Polyline final : public Curve {
 public:
  /// @param from   first pose, at rest
  /// @param list   at least one pose. velocity: the fraction of the limits that the axis has which is used most on the
  ///        line to the pose; acceleration: of the line's ramps; pass: without a stop
  /// @param macrostep_s  duration of a macrostep, > 0 [s]
  /// @throws FaultError bad_trajectory  no pose, sizes that differ, numbers that are not finite, a fraction
  ///         or a limit out of its range
  Polyline(const Coordinates& from, const std::vector<ViaPoint>& list, const MotionLimits& limits,
           double macrostep_s);

  [[nodiscard]] double duration() const override { return duration_; }
  [[nodiscard]] Coordinates at(double t) const override;

 private:
  /// One line. Its ways and speeds are shares of those at full speed: seconds, and 0..1.
  struct Line {
    Coordinates from, velocity;  // velocity: at full speed
    double length{};             // [s]
    double ramp{};               // change of speed [1/s]
    double corner{1};            // largest speed at its end
    double first{}, peak{}, last{};
    double begin{};  // [s]
  };
  void look_ahead();

  Coordinates end_;
  std::vector<Line> lines_;
  double duration_{};
};

}  // namespace mrroc::ecp
