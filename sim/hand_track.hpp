// A way through the air with its times, along which the operator's hand leads a tool.
#pragma once
#include <vector>

#include "base/spatial.hpp"

namespace mrroc::sim {

/// Where a hand is to be at some time.
struct TrackPoint {
  double t{};                  ///< since the beginning [s]
  Vector3 p{Vector3::Zero()};  ///< in sheet coordinates, z above the paper [m]
};

/// A hand's place, speed and change of speed, in sheet coordinates.
struct TrackMotion {
  Vector3 position{Vector3::Zero()};      ///< [m]
  Vector3 velocity{Vector3::Zero()};      ///< [m/s]
  Vector3 acceleration{Vector3::Zero()};  ///< [m/s^2]
};

/// Points joined by cubics, so that the speed has no steps.
class HandTrack {
 public:
  /// No way at all: it ends when it begins, at the origin.
  HandTrack() = default;
  /// @param points  at least one; times finite, from 0 on, each later than the one before
  explicit HandTrack(std::vector<TrackPoint> points);

  /// @return whether there is none
  [[nodiscard]] bool empty() const { return points_.empty(); }
  /// @return when it ends [s]
  [[nodiscard]] double duration() const { return points_.empty() ? 0 : points_.back().t; }
  /// @param t  [s], clipped to the track @return the motion; at rest before its beginning and after its end
  [[nodiscard]] TrackMotion at(double t) const;

 private:
  std::vector<TrackPoint> points_;
  std::vector<Vector3> speeds_;  // at the points [m/s]
};

}  // namespace mrroc::sim
