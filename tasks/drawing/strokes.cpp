#include "tasks/drawing/strokes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc::drawing {
namespace {

constexpr std::size_t kRun = 32;  // segments per box: near the square root of a long stroke's number

Point nearest_on_segment(const Point& p, const Point& a, const Point& b) {
  const Point along = b - a;
  const double square = along.squaredNorm();
  return square > 0 ? Point(a + along * std::clamp((p - a).dot(along) / square, 0.0, 1.0)) : a;
}

}  // namespace

Box bounds(const Drawing& drawing) {
  Box box;
  for (const Stroke& stroke : drawing)
    for (const Point& p : stroke) box.extend(p);
  return box;
}

double length(const Stroke& stroke) {
  double sum = 0;
  for (std::size_t k = 1; k < stroke.size(); ++k) sum += (stroke[k] - stroke[k - 1]).norm();
  return sum;
}

Stroke resampled_to(const Stroke& stroke, std::size_t count) {
  if (stroke.empty()) return stroke;
  const double step = length(stroke) / static_cast<double>(count - 1);
  Stroke points{stroke.front()};
  points.reserve(count);
  double passed = 0;  // length of the polyline before corner k - 1
  std::size_t k = 1;
  while (points.size() + 1 < count) {
    const double target = step * static_cast<double>(points.size());
    while (k < stroke.size() && passed + (stroke[k] - stroke[k - 1]).norm() < target) {
      passed += (stroke[k] - stroke[k - 1]).norm();
      ++k;
    }
    if (k >= stroke.size()) {
      points.push_back(stroke.back());
      continue;
    }
    const double piece = (stroke[k] - stroke[k - 1]).norm();
    const double part = piece > 0 ? (target - passed) / piece : 0;
    points.push_back(stroke[k - 1] + (stroke[k] - stroke[k - 1]) * part);
  }
  points.push_back(stroke.back());
  return points;
}

Stroke resampled(const Stroke& stroke, double spacing_mm) {
  if (stroke.empty()) return stroke;
  const double total = length(stroke);
  if (total <= 0) return {stroke.front()};
  const double pieces = std::max(1.0, std::round(total / spacing_mm));
  return resampled_to(stroke, static_cast<std::size_t>(pieces) + 1);
}

NearestPoint::NearestPoint(Stroke stroke) : points_(std::move(stroke)) {
  for (std::size_t first = 0; first == 0 || first + 1 < points_.size(); first += kRun) {
    Box& box = runs_.emplace_back();
    for (std::size_t k = first; k <= std::min(first + kRun, points_.size() - 1); ++k) box.extend(points_[k]);
  }
}

Point NearestPoint::operator()(const Point& p) const {
  Point best = points_.front();
  double best_square = (best - p).squaredNorm();
  const auto try_run = [&](std::size_t run) {
    const std::size_t last = std::min((run + 1) * kRun, points_.size() - 1);
    for (std::size_t k = run * kRun + 1; k <= last; ++k) {
      const Point q = nearest_on_segment(p, points_[k - 1], points_[k]);
      const double square = (q - p).squaredNorm();
      if (square < best_square) {
        best_square = square;
        best = q;
      }
    }
  };
  // The run whose box is nearest first: it nearly always holds the answer, and the others fall to one test.
  std::size_t likely = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const double square = runs_[run].squaredExteriorDistance(p);
    if (square < least) {
      least = square;
      likely = run;
    }
  }
  try_run(likely);
  for (std::size_t run = 0; run < runs_.size(); ++run)
    if (run != likely && runs_[run].squaredExteriorDistance(p) < best_square) try_run(run);
  return best;
}

}  // namespace mrroc::drawing
