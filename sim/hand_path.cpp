#include "sim/hand_path.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::sim {
namespace {

using Points = std::vector<Eigen::Vector2d>;

constexpr double kSpacing = 2.5e-4;  // of the samples [m]
constexpr double kBendBase = 1e-3;   // bends are measured over this distance to both sides [m]
constexpr double kCrawl = 1e-3;      // slowest speed, so that a path ends [m/s]
constexpr double kSamePoint = 1e-12;

double turn(const Eigen::Vector2d& before, const Eigen::Vector2d& after) {
  return std::abs(std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after)));
}

// Samples of the polyline at equal distances, both ends included.
Points resampled(const Points& points, double length, std::size_t intervals) {
  Points out{points.front()};
  const double spacing = length / static_cast<double>(intervals);
  double walked = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double piece = (points[k] - points[k - 1]).norm();
    while (out.size() < intervals) {
      const double ahead = spacing * static_cast<double>(out.size()) - walked;
      if (ahead > piece) break;
      out.push_back(points[k - 1] + ahead / piece * (points[k] - points[k - 1]));
    }
    walked += piece;
  }
  out.resize(intervals, points.back());
  out.push_back(points.back());
  return out;
}

}  // namespace

std::vector<Points> cut_at_corners(const Points& points, double corner) {
  Points distinct{points.front()};
  for (const auto& p : points)
    if ((p - distinct.back()).norm() > kSamePoint) distinct.push_back(p);

  std::vector<Points> pieces{{distinct.front()}};
  for (std::size_t k = 1; k < distinct.size(); ++k) {
    pieces.back().push_back(distinct[k]);
    if (k + 1 < distinct.size() &&
        turn(distinct[k] - distinct[k - 1], distinct[k + 1] - distinct[k]) > corner)
      pieces.push_back({distinct[k]});
  }
  return pieces;
}

HandPath::HandPath(const Points& points, const Limits& limits) {
  points_ = {points.front()};
  for (std::size_t k = 1; k < points.size(); ++k) length_ += (points[k] - points[k - 1]).norm();
  if (length_ <= kSamePoint) {
    length_ = 0;
    return;
  }
  const auto intervals = static_cast<std::size_t>(std::max(1.0, std::ceil(length_ / kSpacing)));
  points_ = resampled(points, length_, intervals);
  spacing_ = length_ / static_cast<double>(intervals);
  speed_.assign(points_.size(), limits.speed);

  const auto base = static_cast<std::size_t>(std::max(1.0, std::round(kBendBase / spacing_)));
  for (std::size_t k = base; k + base < points_.size(); ++k) {
    const double bend = turn(points_[k] - points_[k - base], points_[k + base] - points_[k]) /
                        (static_cast<double>(base) * spacing_);
    if (bend > 0) speed_[k] = std::min(speed_[k], std::sqrt(limits.acceleration / bend));
  }
  speed_.front() = speed_.back() = 0;
  const auto reachable = [&](double v) { return std::sqrt(v * v + 2 * limits.acceleration * spacing_); };
  for (std::size_t k = 1; k < speed_.size(); ++k) speed_[k] = std::min(speed_[k], reachable(speed_[k - 1]));
  for (std::size_t k = speed_.size() - 1; k-- > 0;) speed_[k] = std::min(speed_[k], reachable(speed_[k + 1]));
}

std::pair<std::size_t, double> HandPath::locate(double s) const {
  const double samples = std::clamp(s, 0.0, length_) / spacing_;
  const std::size_t k = std::min(static_cast<std::size_t>(samples), points_.size() - 2);
  return {k, samples - static_cast<double>(k)};
}

Eigen::Vector2d HandPath::at(double s) const {
  if (length_ <= 0) return points_.front();
  const auto [k, part] = locate(s);
  return (1 - part) * points_[k] + part * points_[k + 1];
}

double HandPath::speed_at(double s) const {
  if (length_ <= 0) return kCrawl;
  const auto [k, part] = locate(s);
  // Between samples the square of the speed is linear: constant acceleration.
  const double square = (1 - part) * speed_[k] * speed_[k] + part * speed_[k + 1] * speed_[k + 1];
  return std::max(kCrawl, std::sqrt(square));
}

}  // namespace mrroc::sim
