#include "tasks/guide/curve.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::guide {
namespace {

constexpr double kSpacing = 1e-4;    // of the samples [m]
constexpr double kSamePoint = 1e-9;  // [m]
constexpr double kBendBase = 3e-4;   // over which a bend is measured, to either side [m]

Points distinct(const Points& points, bool closed) {
  Points out;
  for (const Point& p : points)
    if (out.empty() || (p - out.back()).norm() > kSamePoint) out.push_back(p);
  if (closed)
    while (out.size() > 1 && (out.front() - out.back()).norm() <= kSamePoint) out.pop_back();
  return out;
}

double length_of(const Points& points) {
  double sum = 0;
  for (std::size_t k = 1; k < points.size(); ++k) sum += (points[k] - points[k - 1]).norm();
  return sum;
}

/// Points at equal distances along a polyline, both ends included.
Points resampled(const Points& points) {
  const double length = length_of(points);
  const auto intervals = static_cast<std::size_t>(std::max(1.0, std::ceil(length / kSpacing)));
  const double spacing = length / static_cast<double>(intervals);
  Points out{points.front()};
  double walked = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double piece = (points[k] - points[k - 1]).norm();
    for (double ahead = spacing * static_cast<double>(out.size()) - walked;
         ahead <= piece && out.size() < intervals; ahead = spacing * static_cast<double>(out.size()) - walked)
      out.emplace_back(points[k - 1] + ahead / piece * (points[k] - points[k - 1]));
    walked += piece;
  }
  out.resize(intervals, points.back());
  out.push_back(points.back());
  return out;
}

/// Means over so many samples to either side; near an open end over as many as there are before it, so that ends stay.
Points averaged(const Points& samples, std::size_t reach, bool closed) {
  const std::size_t n =
      closed ? samples.size() - 1 : samples.size();  // the last one of a closed curve is the first one
  const std::size_t before = closed ? std::min(reach, n) : 0;
  Points sums{
      Point::
          Zero()};  // of the samples before; of a closed curve from `before` samples ahead of the first one
  for (std::size_t k = 0; k < n + 2 * before; ++k)
    sums.emplace_back(sums.back() + samples[(k + n - before) % n]);
  Points out;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t half = closed ? before : std::min({reach, k, n - 1 - k});
    const std::size_t middle = k + before;
    out.emplace_back((sums[middle + half + 1] - sums[middle - half]) / static_cast<double>(2 * half + 1));
  }
  if (closed) out.push_back(out.front());
  return out;
}

double turn(const Point& before, const Point& after) {
  return std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
}

}  // namespace

SharpCorner::SharpCorner(const Point& where) : std::runtime_error("sharp corner"), where_(where) {}

Curve::Curve(const Points& points, bool closed, double rounding) : closed_(closed) {
  Points line = distinct(points, closed);
  if (closed && !line.empty()) line.push_back(line.front());
  if (line.size() < 2 || length_of(line) < kLeastLength) throw std::invalid_argument("too short for a curve");
  Points samples = resampled(line);
  if (rounding > 0)
    samples = resampled(averaged(samples, static_cast<std::size_t>(std::round(rounding / kSpacing)), closed));
  length_ = length_of(samples);
  if (length_ < kLeastLength) throw std::invalid_argument("too short for a curve");
  spacing_ = length_ / static_cast<double>(samples.size() - 1);
  if (closed) samples.pop_back();
  points_ = std::move(samples);
  find_tangents();
  find_bends();
  const auto bad = [&](std::size_t k) { return radius(static_cast<double>(k) * spacing_) < kLeastRadius; };
  for (std::size_t k = 0; k < points_.size(); ++k)
    if (bad(k)) throw SharpCorner(points_[k]);
}

std::size_t Curve::wrapped(std::ptrdiff_t k) const {
  const auto n = static_cast<std::ptrdiff_t>(points_.size());
  return static_cast<std::size_t>(closed_ ? ((k % n) + n) % n : std::clamp<std::ptrdiff_t>(k, 0, n - 1));
}

std::ptrdiff_t Curve::index_near(double s) const { return std::lround(s / spacing_); }

void Curve::find_tangents() {
  const auto n = static_cast<std::ptrdiff_t>(points_.size());
  for (std::ptrdiff_t k = 0; k < n; ++k) {
    const Point chord = points_[wrapped(k + 1)] - points_[wrapped(k - 1)];
    tangents_.push_back(chord.norm() > kSamePoint ? Point(chord.normalized()) : Point::UnitX());
  }
}

double Curve::radius(double s) const {
  const auto base = static_cast<std::ptrdiff_t>(std::max(1.0, std::round(kBendBase / spacing_)));
  const std::ptrdiff_t k = index_near(s);
  const double bend = turn(tangents_[wrapped(k - base)], tangents_[wrapped(k + base)]);
  return 2 * static_cast<double>(base) * spacing_ / std::max(bend, 1e-9);
}

void Curve::find_bends() {
  const auto reach = static_cast<std::ptrdiff_t>(std::ceil(kNear / spacing_));
  std::vector<double> radii;
  for (std::size_t k = 0; k < points_.size(); ++k) radii.push_back(radius(static_cast<double>(k) * spacing_));
  for (std::ptrdiff_t k = 0; k < static_cast<std::ptrdiff_t>(points_.size()); ++k) {
    double least = HUGE_VAL;
    for (std::ptrdiff_t j = k - reach; j <= k + reach; ++j) least = std::min(least, radii[wrapped(j)]);
    narrowest_.push_back(least);
  }
}

CurvePlace Curve::at(double s) const {
  if (closed_) s -= length_ * std::floor(s / length_);
  s = std::clamp(s, 0.0, length_);
  const double samples = s / spacing_;
  const auto k =
      static_cast<std::ptrdiff_t>(std::min(std::floor(samples), static_cast<double>(intervals() - 1)));
  const double part = samples - static_cast<double>(k);
  const std::size_t a = wrapped(k), b = wrapped(k + 1);
  const Point tangent = (1 - part) * tangents_[a] + part * tangents_[b];
  return {.s = s, .point = (1 - part) * points_[a] + part * points_[b], .tangent = tangent.normalized()};
}

CurvePlace Curve::place_around(const Point& p, std::ptrdiff_t k) const {
  // The nearest point of the two pieces that meet in sample k.
  CurvePlace best;
  double least = HUGE_VAL;
  for (const std::ptrdiff_t first : {k - 1, k}) {
    if (!closed_ && (first < 0 || first + 1 >= static_cast<std::ptrdiff_t>(points_.size()))) continue;
    const Point &a = points_[wrapped(first)], &b = points_[wrapped(first + 1)];
    const double part = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    const double distance = (p - a - part * (b - a)).squaredNorm();
    if (distance >= least) continue;
    least = distance;
    best = at(spacing_ * (static_cast<double>(first) + part));
  }
  if (closed_) return best;
  const double along = (p - best.point).dot(best.tangent);
  if (best.s <= 0) best.beyond = std::min(0.0, along);
  if (best.s >= length_) best.beyond = std::max(0.0, along);
  return best;
}

CurvePlace Curve::nearest(const Point& p, double s) const {
  const auto square = [&](std::ptrdiff_t k) { return (p - points_[wrapped(k)]).squaredNorm(); };
  std::ptrdiff_t k = index_near(at(s).s);
  auto left = static_cast<std::ptrdiff_t>(intervals());  // once around a closed curve is enough
  for (const std::ptrdiff_t step : {1, -1})
    while (left-- > 0 && square(k + step) < square(k)) k += step;
  return place_around(p, k);
}

CurvePlace Curve::nearest(const Point& p) const {
  const auto best =
      std::ranges::min_element(points_, {}, [&](const Point& q) { return (p - q).squaredNorm(); });
  return place_around(p, best - points_.begin());
}

}  // namespace mrroc::guide
