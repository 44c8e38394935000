// Straight lines in space with rounded corners and a trapezoidal speed: the pose of E moved by KDL.
#pragma once
#include <memory>
#include <vector>

#include "base/pose.hpp"
#include "ecp/generators/curve.hpp"

namespace mrroc::ecp {

/// Limits of a motion along a path.
struct PathLimits {
  double velocity{0.05};     ///< along the path [m/s], > 0
  double acceleration{0.2};  ///< along the path [m/s^2], > 0
  double corner{0};          ///< radius of the arcs that round the corners [m]; 0: E stops at each pose
  double lever{0.2};         ///< a turn by one radian takes as long as a way of this length [m], > 0
};

/// E moves in straight lines from pose to pose while it turns about one axis of space each time. Unlike a
/// motion through Euler angles or rotation vectors, the way does not depend on coordinates. With corners
/// rounded the inner poses are passed near by, without one they are reached.
class StraightPath final : public Curve {
 public:
  /// @param poses  at least two, of E in the base
  /// @throws FaultError bad_trajectory  poses that cannot be joined so: a corner that turns back, or a
  ///         section too short for its arcs; a limit out of its range
  StraightPath(const std::vector<Pose>& poses, const PathLimits& limits);
  ~StraightPath() override;

  [[nodiscard]] double duration() const override;
  /// @return x, y, z [m], angle-axis [rad] of E in the base
  [[nodiscard]] Coordinates at(double t) const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace mrroc::ecp
