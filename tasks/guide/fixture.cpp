#include "tasks/guide/fixture.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::guide {
namespace {

double outside(double x, double side) { return x - std::clamp(x, -side / 2, side / 2); }

}  // namespace

double Standing::off() const { return std::hypot(y, z); }

double Standing::distance() const { return std::hypot(off(), beyond[0], beyond[1]); }

Standing Fixture::stand(const Vector3& tool, std::optional<double> s) const {
  const Vector3 p = T_0F_.inverse() * tool;
  if (!curve_) return {.z = p.z(), .beyond = {outside(p.x(), sides_[0]), outside(p.y(), sides_[1])}};
  const CurvePlace place = s ? curve_->nearest(p.head<2>(), *s) : curve_->nearest(p.head<2>());
  const Point across(-place.tangent.y(), place.tangent.x());
  return {
      .s = place.s, .y = (p.head<2>() - place.point).dot(across), .z = p.z(), .beyond = {place.beyond, 0}};
}

Matrix3 Fixture::axes(double s) const {
  if (!curve_) return T_0F_.R;
  const Point t = curve_->at(s).tangent;
  Matrix3 R;
  R << t.x(), -t.y(), 0, t.y(), t.x(), 0, 0, 0, 1;
  return T_0F_.R * R;
}

std::vector<Vector3> Fixture::points(double distance) const {
  std::vector<Vector3> all;
  const auto pieces = [&](double length) { return std::max(1.0, std::ceil(length / distance)); };
  if (curve_) {
    const double n = pieces(curve_->length());
    for (double k = 0; k <= n; ++k) {
      const Point p = curve_->at(curve_->length() * k / n).point;
      all.emplace_back(T_0F_ * Vector3(p.x(), p.y(), 0));
    }
    return all;
  }
  const double n = pieces(sides_[0]), m = pieces(sides_[1]);
  for (double k = 0; k <= n; ++k)
    for (double l = 0; l <= m; ++l)
      all.emplace_back(T_0F_ * Vector3((k / n - 0.5) * sides_[0], (l / m - 0.5) * sides_[1], 0));
  return all;
}

}  // namespace mrroc::guide
