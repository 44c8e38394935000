#include "tasks/drawing/playback.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::drawing {
namespace {

/// Sums of paces are whole up to rounding: a rest smaller than this is none.
constexpr double kRounding = 1e-9;

std::size_t node_of(double p) { return static_cast<std::size_t>(std::floor(p + kRounding)); }

}  // namespace

bool next_node_is(const Recording& recording, double p, bool on_paper) {
  const std::size_t n = node_of(p);
  return n < recording.size() && (recording[n].pen == PenState::paper_surface) == on_paper;
}

Advance advance(const Recording& recording, double p, double pace, bool on_paper) {
  Advance a{p, 0, 0};
  double left = pace;
  while (left > kRounding && next_node_is(recording, a.p, on_paper)) {
    const std::size_t n = node_of(a.p);
    const double share = std::min(left, static_cast<double>(n + 1) - a.p);
    a.vx += share * recording[n].velocity[Axis::x];
    a.vy += share * recording[n].velocity[Axis::y];
    a.p += share;
    left -= share;
  }
  if (std::abs(a.p - std::round(a.p)) < kRounding) a.p = std::round(a.p);
  return a;
}

}  // namespace mrroc::drawing
