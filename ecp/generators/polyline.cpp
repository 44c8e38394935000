#include "ecp/generators/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mrroc::ecp {
namespace {

/// @return how often all of b goes into a, per axis, at least; infinite where b is nothing
double least_ratio(const Coordinates& a, const Coordinates& b) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index k = 0; k < a.size(); ++k)
    if (std::abs(b[k]) > 0) least = std::min(least, a[k] / std::abs(b[k]));
  return least;
}

/// Speed after a way on which it grows from v.
double grown(double v, double ramp, double way) { return std::sqrt(v * v + 2 * ramp * way); }

}  // namespace

Polyline::Polyline(const Coordinates& from, const std::vector<ViaPoint>& list, const MotionLimits& limits,
                   double macrostep_s) {
  check_list(from, list, limits, macrostep_s);
  end_ = list.back().pose;
  Coordinates start = from;
  bool pass = false;
  for (const ViaPoint& via : list) {
    const Coordinates way = via.pose - start;
    const double length = 1 / least_ratio(via.velocity * limits.velocity, way);
    if (length > 0) {
      Line line{.from = start, .velocity = way / length, .length = length};
      line.ramp = least_ratio(via.acceleration * limits.acceleration, line.velocity);
      if (!lines_.empty())
        lines_.back().corner =
            pass ? std::min(1.0, least_ratio(via.acceleration * macrostep_s * limits.acceleration,
                                             line.velocity - lines_.back().velocity))
                 : 0;
      lines_.push_back(line);
      pass = true;
    }
    pass = pass && via.pass;
    start = via.pose;
  }
  if (!lines_.empty()) look_ahead();
}

void Polyline::look_ahead() {
  lines_.back().corner = 0;
  double speed = 0;
  for (Line& line : lines_) {
    line.first = speed;
    speed = line.last = std::min(line.corner, grown(speed, line.ramp, line.length));
  }
  for (std::size_t k = lines_.size(); k-- > 0;) {
    Line& line = lines_[k];
    line.last = std::min(line.last, speed);
    speed = line.first = std::min(line.first, grown(line.last, line.ramp, line.length));
  }
  for (Line& line : lines_) {
    const double squares = line.first * line.first + line.last * line.last;
    line.peak = std::min(1.0, std::sqrt(line.ramp * line.length + squares / 2));
    const double ramps = (line.peak * line.peak - squares / 2) / line.ramp;  // as a way
    const double even = std::max(0.0, line.length - ramps) / line.peak;
    line.begin = duration_;
    duration_ += (2 * line.peak - line.first - line.last) / line.ramp + even;
  }
}

Coordinates Polyline::at(double t) const {
  if (t >= duration_ || lines_.empty()) return end_;
  std::size_t k = lines_.size() - 1;
  while (k > 0 && t < lines_[k].begin) --k;
  const Line& line = lines_[k];
  const double end = k + 1 < lines_.size() ? lines_[k + 1].begin : duration_;
  const double tau = std::max(0.0, t - line.begin), left = end - t;
  double way = 0;
  if (const double down = (line.peak - line.last) / line.ramp; left < down) {
    way = line.length - left * (line.last + line.ramp * left / 2);
  } else {
    const double up = std::min(tau, (line.peak - line.first) / line.ramp);
    way = up * (line.first + line.ramp * up / 2) + (tau - up) * line.peak;
  }
  return line.from + way * line.velocity;
}

}  // namespace mrroc::ecp
