#include "tasks/drawing/belt.hpp"

#include "base/latency.hpp"

namespace mrroc::drawing {

BeltTrack seen_at(BeltTrack track, double position) {
  track.seen = {position, track.seen[0], track.seen[1]};
  return track;
}

double horizon(int n_s) { return static_cast<double>(latency::kLoop) + 1.0 / n_s; }

double foreseen(const BeltTrack& track, double ahead) {
  const auto& [p0, p1, p2] = track.seen;
  return p0 + ahead * (p0 - p1) + ahead * (ahead + 1) / 2 * (p0 - 2 * p1 + p2);
}

BeltTrack follow(BeltTrack track, double ahead) {
  if (!track.follows) track.start = track.seen[0];
  track.follows = true;
  track.followed = foreseen(track, ahead) - track.start;
  return track;
}

}  // namespace mrroc::drawing
