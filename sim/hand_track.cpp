#include "sim/hand_track.hpp"

#include <algorithm>
#include <utility>

namespace mrroc::sim {

HandTrack::HandTrack(std::vector<TrackPoint> points)
    : points_(std::move(points)), speeds_(points_.size(), Vector3::Zero()) {
  for (std::size_t k = 1; k + 1 < points_.size(); ++k)
    speeds_[k] = (points_[k + 1].p - points_[k - 1].p) / (points_[k + 1].t - points_[k - 1].t);
}

TrackMotion HandTrack::at(double t) const {
  if (points_.empty()) return {};
  if (t <= 0) return {.position = points_.front().p};
  if (t >= duration()) return {.position = points_.back().p};
  const auto later = std::ranges::upper_bound(points_, t, {}, &TrackPoint::t);
  const auto k = static_cast<std::size_t>(later - points_.begin()) - 1;
  const TrackPoint &a = points_[k], &b = points_[k + 1];
  const double h = b.t - a.t, u = (t - a.t) / h;
  const Vector3 way = b.p - a.p, v0 = h * speeds_[k], v1 = h * speeds_[k + 1];
  // Hermite's cubic: a + u v0 + u^2 (3 way - 2 v0 - v1) + u^3 (v0 + v1 - 2 way)
  const Vector3 square = 3 * way - 2 * v0 - v1, cube = v0 + v1 - 2 * way;
  return {.position = a.p + u * (v0 + u * (square + u * cube)),
          .velocity = (v0 + u * (2 * square + 3 * u * cube)) / h,
          .acceleration = (2 * square + 6 * u * cube) / (h * h)};
}

}  // namespace mrroc::sim
