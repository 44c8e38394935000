// The best rigid alignment of ink with a reference, by iterated nearest points.
#include <algorithm>
#include <cmath>

#include "base/spatial.hpp"
#include "tasks/drawing/figures.hpp"

namespace mrroc::drawing {
namespace {

constexpr double kMostSamples = 2000;    // more would only cost time
constexpr int kMostIterations = 100;     // a bound; a dozen are usual
constexpr double kConverged = 1e-6;      // relative gain of an iteration that is not worth another
constexpr double kOnStroke = 1e-9;       // [mm]
constexpr double kDamping = 1e-6;        // of directions that the ink does not tell, as the turn of a circle
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

// Error of a motion, and two better motions that may follow from it.
struct Trial {
  Rigid motion;
  double square{};  // sum of squared distances [mm^2]
  Rigid matched;    // best for the nearest points as they are now: never worse, but short where strokes slide
                    // along each other
  Rigid newton;     // best if each point's stroke were straight: far fewer steps, but may be worse
};

// Distances as linear functions of a further motion (Gauss-Newton). Turns are measured as arcs at the sheet's
// rim.
class Linear {
 public:
  void add(const Point& turned, const Point& error) {
    const double distance = error.norm();
    if (distance < kOnStroke) return;  // no direction
    const Point n = error / distance;
    const Vector3 a(n.dot(Point(-turned.y(), turned.x())) / kRim, n.x(), n.y());
    H_ += a * a.transpose();
    g_ += a * distance;
  }

  [[nodiscard]] Rigid from(const Rigid& motion) const {
    const Matrix3 damped = H_ + (kDamping * H_.trace() + 1e-12) * Matrix3::Identity();
    const Vector3 step = damped.ldlt().solve(-g_);
    return {motion.turn + step[0] / kRim, motion.shift + step.tail<2>()};
  }

 private:
  Matrix3 H_{Matrix3::Zero()};
  Vector3 g_{Vector3::Zero()};
};

Trial attempt(const std::vector<Pair>& pairs, const Rigid& motion) {
  Trial trial;
  trial.motion = motion;
  Linear linear;
  Stroke from;
  Stroke to;
  for (const Pair& pair : pairs)
    for (const Point& p : pair.ink) {
      const Point moved = motion(p);
      from.push_back(p);
      to.push_back(pair.nearest(moved));
      trial.square += (moved - to.back()).squaredNorm();
      linear.add(moved - motion.shift, moved - to.back());
    }
  trial.matched = fit(from, to);
  trial.newton = linear.from(motion);
  return trial;
}

Trial iterate(const std::vector<Pair>& pairs, const Rigid& start) {
  Trial best = attempt(pairs, start);
  for (int k = 0; k < kMostIterations; ++k) {
    Trial trial = attempt(pairs, best.newton);
    if (!(trial.square < best.square)) trial = attempt(pairs, best.matched);
    if (!(trial.square < best.square)) break;
    const bool converged = trial.square > (1 - kConverged) * best.square;
    best = trial;
    if (converged) break;
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
