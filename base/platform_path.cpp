#include "base/platform_path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mrroc {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kIntervals = static_cast<double>(kFragmentKnots - 1);

/// Weights of a cubic Hermite polynomial: of the value and of the slope at its beginning and at its end.
struct HermiteBasis {
  double begin, begin_slope, end, end_slope;

  /// @param t  0 at the beginning to 1 at the end
  explicit HermiteBasis(double t)
      : begin((1 + 2 * t) * (1 - t) * (1 - t)),
        begin_slope(t * (1 - t) * (1 - t)),
        end(t * t * (3 - 2 * t)),
        end_slope(t * t * (t - 1)) {}

  [[nodiscard]] double operator()(double from, double from_slope, double to, double to_slope) const {
    return begin * from + begin_slope * from_slope + end * to + end_slope * to_slope;
  }
};

}  // namespace

PathPoint point_at(const Fragment& fragment, double s) noexcept {
  const double place = s > 0 ? kIntervals * std::min(s, 1.) : 0;
  const auto k = std::min(static_cast<std::size_t>(place), kFragmentKnots - 2);
  const double t = place - static_cast<double>(k);
  const double interval = fragment.steps * kPlatformPeriod / kIntervals;
  const PathPoint& a = fragment.knot[k];
  const PathPoint& b = fragment.knot[k + 1];
  const HermiteBasis hermite(t);
  const double from = a.v * interval;
  const double to = b.v * interval;
  PathPoint point;
  point.p.x = hermite(a.p.x, from * std::cos(a.p.phi), b.p.x, to * std::cos(b.p.phi));
  point.p.y = hermite(a.p.y, from * std::sin(a.p.phi), b.p.y, to * std::sin(b.p.phi));
  point.p.phi = hermite(a.p.phi, a.w * interval, b.p.phi, b.w * interval);
  point.v = std::lerp(a.v, b.v, t);
  point.w = std::lerp(a.w, b.w, t);
  return point;
}

double wrap_angle(double angle) noexcept {
  const double wrapped = std::remainder(angle, kTurn);
  return wrapped <= -std::numbers::pi ? std::numbers::pi : wrapped;
}

}  // namespace mrroc
