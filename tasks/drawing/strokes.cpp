#include "tasks/drawing/strokes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mrroc::drawing {
namespace {

constexpr std::size_t kLeaf = 4;  // segments that are not worth a box of their own

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

bool NearestPoint::Range::leaf() const { return last - first <= kLeaf; }

NearestPoint::Range NearestPoint::Range::half(std::size_t which) const {
  const std::size_t middle = (first + last) / 2;
  return which == 0 ? Range{2 * node + 1, first, middle} : Range{2 * node + 2, middle, last};
}

NearestPoint::NearestPoint(Stroke stroke) : points_(std::move(stroke)) { build({0, 0, points_.size() - 1}); }

void NearestPoint::build(const Range& range) {
  if (range.node >= boxes_.size()) boxes_.resize(range.node + 1);
  Box box;
  for (std::size_t k = range.first; k <= range.last; ++k) box.extend(points_[k]);
  boxes_[range.node] = box;
  if (range.leaf()) return;
  build(range.half(0));
  build(range.half(1));
}

Point NearestPoint::operator()(const Point& p) const {
  Best best{points_.front(), (points_.front() - p).squaredNorm()};
  search({0, 0, points_.size() - 1}, p, best);
  return best.point;
}

void NearestPoint::search(const Range& range, const Point& p, Best& best) const {
  if (range.leaf()) {
    for (std::size_t k = range.first; k < range.last; ++k) {
      const Point q = nearest_on_segment(p, points_[k], points_[k + 1]);
      const double square = (q - p).squaredNorm();
      if (square < best.square) best = {q, square};
    }
    return;
  }
  std::array halves{range.half(0), range.half(1)};
  const auto away = [&](const Range& r) { return boxes_[r.node].squaredExteriorDistance(p); };
  if (away(halves[1]) < away(halves[0])) std::swap(halves[0], halves[1]);
  for (const Range& half : halves)
    if (away(half) < best.square) search(half, p, best);
}

}  // namespace mrroc::drawing
