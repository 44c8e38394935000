// The best rigid alignment of ink with a reference, by closest-point iteration.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "tasks/drawing/figures.hpp"

namespace mrroc::drawing {
namespace {

constexpr double kMostSamples = 2000;    // more would only cost time
constexpr int kMostIterations = 150;     // a bound; a few dozen are usual
constexpr double kConverged = 1e-7;      // [mm] motion of the sheet's rim in one iteration
constexpr double kStrideGrowth = 1.5;    // from one successful step to the next
constexpr double kRim = kSheetSize / 2;  // [mm]

// Two strokes with the same number.
struct Pair {
  Stroke ink;
  Stroke reference;
  NearestPoint nearest;
};

// Motion with the least sum of squared distances between points with the same index (Kabsch in the plane).
Rigid fit(const Stroke& from, const Stroke& to) {
  const auto mean = [](const Stroke& points) {
    Point sum(0, 0);
    for (const Point& p : points) sum += p;
    return Point(sum / static_cast<double>(points.size()));
  };
  const Point a = mean(from);
  const Point b = mean(to);
  double cross = 0;
  double dot = 0;
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Point p = from[k] - a;
    const Point q = to[k] - b;
    cross += p.x() * q.y() - p.y() * q.x();
    dot += p.dot(q);
  }
  Rigid motion;
  motion.turn = std::atan2(cross, dot);
  motion.shift = b - Eigen::Rotation2Dd(motion.turn) * a;
  return motion;
}

Rigid fit_by_length(const std::vector<Pair>& pairs) {
  Stroke from;
  Stroke to;
  for (const Pair& pair : pairs) {
    const std::size_t count = std::max<std::size_t>(2, pair.ink.size());
    const Stroke a = resampled_to(pair.ink, count);
    const Stroke b = resampled_to(pair.reference, count);
    from.insert(from.end(), a.begin(), a.end());
    to.insert(to.end(), b.begin(), b.end());
  }
  return fit(from, to);
}

// How well a motion fits, and the better one that follows from it.
struct Trial {
  Rigid motion;
  double square{std::numeric_limits<double>::infinity()};  // sum of squared distances [mm^2]
  Rigid next;
};

Trial attempt(const std::vector<Pair>& pairs, const Rigid& motion) {
  Trial trial{motion, 0, {}};
  Stroke from;
  Stroke to;
  for (const Pair& pair : pairs)
    for (const Point& p : pair.ink) {
      const Point moved = motion(p);
      from.push_back(p);
      to.push_back(pair.nearest(moved));
      trial.square += (to.back() - moved).squaredNorm();
    }
  trial.next = fit(from, to);
  return trial;
}

// Each step never makes the sum larger, but is short where strokes slide along each other. Going farther in
// its direction saves most of the way; where that fails, the plain step is taken.
Trial iterate(const std::vector<Pair>& pairs, const Rigid& start) {
  Trial best = attempt(pairs, start);
  double stride = 1;
  for (int k = 0; k < kMostIterations; ++k) {
    const double turn = std::remainder(best.next.turn - best.motion.turn, 2 * std::numbers::pi);
    const Point shift = best.next.shift - best.motion.shift;
    if (kRim * std::abs(turn) + shift.norm() < kConverged) break;
    const Trial trial =
        attempt(pairs, {best.motion.turn + stride * turn, best.motion.shift + stride * shift});
    if (trial.square < best.square) {
      best = trial;
      stride *= kStrideGrowth;
    } else if (stride > 1) {
      stride = 1;
    } else {
      break;  // down to rounding
    }
  }
  return best;
}

}  // namespace

Rigid best_alignment(const Drawing& ink, const Drawing& reference) {
  double total = 0;
  for (const Stroke& stroke : ink) total += length(stroke);
  const double spacing = std::max(kSampleSpacing, total / kMostSamples);
  std::vector<Pair> pairs;
  for (std::size_t s = 0; s < std::min(ink.size(), reference.size()); ++s)
    if (!ink[s].empty() && !reference[s].empty())
      pairs.push_back({resampled(ink[s], spacing), reference[s], NearestPoint(reference[s])});
  if (pairs.empty()) return {};
  const Trial by_length = iterate(pairs, fit_by_length(pairs));
  const Trial in_place = iterate(pairs, {});
  return by_length.square <= in_place.square ? by_length.motion : in_place.motion;
}

}  // namespace mrroc::drawing
